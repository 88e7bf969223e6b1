// The haptic units on the USB as the system lists them, and the nodes a driver would open. Looks, opens nothing.
// Identities: reference/devices 1, 3. Also the rules by which the person at the machine may use them.
#pragma once

#include <string>
#include <vector>

#include "app/doctor/machine.h"

namespace app {

enum class UnitMaker { systems_3d, wooden_haptics, falcon };

struct HapticUnit {
  UnitMaker maker = UnitMaker::systems_3d;
  std::string name;                          ///< "Novint Falcon (0403:cb48)"
  std::vector<std::filesystem::path> nodes;  ///< in /dev: the bus's own, ttyACM*, hidraw*
  bool is_serial = false;                    ///< has a ttyACM
};

std::vector<HapticUnit> hapticUnits(const Machine& machine);

/// For /etc/udev/rules.d: whoever sits at the machine may use every unit Molar knows, and no modem program opens one.
std::string udevRules();

/// The file that `udevRules` belongs into.
inline constexpr const char* kUdevRulesFile = "/etc/udev/rules.d/70-molar.rules";

}  // namespace app
