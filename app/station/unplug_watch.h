// Stops the motors when a unit that the vendor's library drives is unplugged, whatever the library reports. Devices
// that Molar drives over USB detect it themselves. If the USB cannot be monitored, it reports that once. Main thread;
// the stop comes from the monitor's.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/station/workstation.h"

namespace haptics {
class PresenceMonitor;
struct PresenceListener;
}  // namespace haptics

namespace app {

class UnplugWatch {
 public:
  /// Creates the monitor that calls the listener.
  using Monitoring = std::function<std::unique_ptr<haptics::PresenceMonitor>(haptics::PresenceListener)>;

  /// Borrows the workstation.
  explicit UnplugWatch(Workstation& workstation);
  /// `stop` is called from the monitor's thread.
  UnplugWatch(std::function<void()> stop, const Monitoring& monitoring);
  ~UnplugWatch();

  /// A new message, if any.
  std::optional<std::string> takeNews();

 private:
  std::atomic<bool> unplugged_{false}, blind_{false};
  bool said_ = false, said_blind_ = false;
  std::string trouble_ = "USB: memory ran out";
  std::unique_ptr<haptics::PresenceMonitor> monitor_;
};

}  // namespace app
