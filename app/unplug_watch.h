// Stops the motors when the unit that the vendor's library drives is pulled out of its socket, whatever the library
// says of it. Devices that Molar drives over USB itself notice by themselves. Where the USB can not be watched, it says
// so once and watches nothing. Main thread; the stop comes from the monitor's own.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "app/workstation.h"

namespace haptics {
class PresenceMonitor;
}

namespace app {

class UnplugWatch {
 public:
  /// Borrows the workstation.
  explicit UnplugWatch(Workstation& workstation);
  ~UnplugWatch();

  /// One line for people when there is something new.
  std::optional<std::string> takeNews();

 private:
  std::atomic<bool> unplugged_{false};
  bool said_ = false;
  std::optional<std::string> trouble_;
  std::unique_ptr<haptics::PresenceMonitor> monitor_;
};

}  // namespace app
