#include "app/unplug_watch.h"

#include <utility>

#include "haptics/device/usb/presence.h"

namespace app {

UnplugWatch::UnplugWatch(Workstation& workstation) {
  haptics::PresenceListener listener;
  listener.left = [this, &workstation](const haptics::PresentDevice& gone) {
    if (!haptics::isClosed(gone.kind)) return;
    workstation.emergencyStop();
    unplugged_.store(true);
  };
  try {
    monitor_ = std::make_unique<haptics::PresenceMonitor>(std::move(listener));
  } catch (const haptics::DeviceError& error) {
    trouble_ = std::string(error.what()) + "; an unplugged unit is noticed by its library only";
  }
}

UnplugWatch::~UnplugWatch() = default;

std::optional<std::string> UnplugWatch::takeNews() {
  if (trouble_) return std::exchange(trouble_, std::nullopt);
  if (said_ || !unplugged_.load()) return std::nullopt;
  said_ = true;
  return "the device was unplugged: the motors are off; plug it in, end and start again";
}

}  // namespace app
