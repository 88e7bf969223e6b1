#include "haptics/device/opened_device.h"
#include "haptics/device/usb/falcon.h"

namespace haptics {

OpenedDevice openFalcon(const std::string& place, const DeviceOptions& options) {
  FalconSettings settings;
  settings.path = place;
  settings.program = options.falcon_program;
  settings.servo_priority = options.servo_priority;
  settings.scale = options.falcon_scale();
  settings.tell = [goes_on = waitPrompt(options)](const std::string& words, double) { return goes_on(words); };
  OpenedDevice opened;
  opened.device = std::make_unique<Falcon>(settings);
  return opened;
}

}  // namespace haptics
