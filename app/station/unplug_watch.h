// Stops the motors when the unit that the vendor's library drives is pulled out of its socket, whatever the library
// says of it. Devices that Molar drives over USB itself notice by themselves. Where the USB can not be watched, or can
// no longer be, it says so once. Main thread; the stop comes from the monitor's own.
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
  /// Who tells the listener of what comes and goes, from now until its end.
  using Monitoring = std::function<std::unique_ptr<haptics::PresenceMonitor>(haptics::PresenceListener)>;

  /// Borrows the workstation.
  explicit UnplugWatch(Workstation& workstation);
  /// `stop` is called from the monitor's thread.
  UnplugWatch(std::function<void()> stop, const Monitoring& monitoring);
  ~UnplugWatch();

  /// One line for people when there is something new.
  std::optional<std::string> takeNews();

 private:
  std::atomic<bool> unplugged_{false}, blind_{false};
  bool said_ = false, said_blind_ = false;
  std::string trouble_ = "USB: memory ran out";
  std::unique_ptr<haptics::PresenceMonitor> monitor_;
};

}  // namespace app
