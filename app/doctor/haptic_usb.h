// The haptic units that sysfs lists on the USB, and the device nodes that a driver would open. Opens nothing. Also the
// udev rules that let the person at the machine use them.
#pragma once

#include <string>
#include <vector>

#include "app/doctor/machine.h"
#include "haptics/device/usb/known_devices.h"

namespace app {

struct HapticUnit {
  haptics::KnownDevice kind = haptics::KnownDevice::touch_of_another_kind;
  std::string name;                          ///< "Novint Falcon (0403:cb48)"
  std::vector<std::filesystem::path> nodes;  ///< in /dev: the bus's own, ttyACM*, hidraw*
  bool is_serial = false;                    ///< has a ttyACM

  bool isTouch() const { return haptics::isClosed(kind); }
};

/// Force Dimension's are left out: Molar has no way to drive them.
std::vector<HapticUnit> hapticUnits(const Machine& machine);

/// For /etc/udev/rules.d: the person at the machine may use every unit that Molar drives, and ModemManager opens none.
std::string udevRules();
/// The file of the local administrator; a package installs the same rules as /usr/lib/udev/rules.d/70-molar.rules.
inline constexpr const char* kUdevRulesFile = "/etc/udev/rules.d/70-molar.rules";

}  // namespace app
