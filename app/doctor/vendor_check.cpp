#include <algorithm>

#include "app/doctor/checks.h"
#include "app/doctor/haptic_usb.h"

namespace app {

Finding checkVendorLibrary(const Machine& machine, const std::string& why_unavailable) {
  const std::vector<HapticUnit> units = hapticUnits(machine);
  const bool is_needed =
      std::ranges::any_of(units, [](const HapticUnit& unit) { return unit.maker == UnitMaker::systems_3d; });
  if (!why_unavailable.empty())
    return {"openhaptics", is_needed ? Health::missing : Health::not_needed, why_unavailable + ".",
            is_needed ? "Then run Touch_Setup, which finds the unit." : "Only a Phantom or Touch needs it."};
  return {"openhaptics", Health::ok, "OpenHaptics by 3D Systems can be loaded."};
}

}  // namespace app
