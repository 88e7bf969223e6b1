#include "haptics/device/opened_device.h"
#include "haptics/device/openhaptics/open_haptics.h"

namespace haptics {

OpenedDevice openPhantom(const std::string& place, const DeviceOptions& options) {
  OpenedDevice opened;
  opened.library = std::make_unique<HdLibrary>();
  opened.device = std::make_unique<OpenHaptics>(
      *opened.library, OpenHapticsSettings{.configuration = place, .docked_value = options.docked_value});
  return opened;
}

}  // namespace haptics
