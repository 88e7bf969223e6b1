#include "haptics/device/opened_device.h"
#include "haptics/device/usb/wooden_haptics.h"

namespace haptics {

OpenedDevice openWooden(const std::string& place, const DeviceOptions& options) {
  WoodenSettings settings = woodenAddressed("wooden:" + place).value();
  settings.servo_priority = options.servo_priority;
  settings.tell = [goes_on = waitPrompt(options)](const std::string& words) {
    return goes_on(words) ? HomingAnswer::wait : HomingAnswer::give_up;
  };
  OpenedDevice opened;
  opened.device = std::make_unique<WoodenHaptics>(settings);
  return opened;
}

}  // namespace haptics
