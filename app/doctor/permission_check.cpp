#include "app/doctor/checks.h"
#include "app/doctor/haptic_usb.h"

namespace app {

Finding checkPermissions(const Machine& machine) {
  const std::vector<HapticUnit> units = hapticUnits(machine);
  if (units.empty())
    return {"permissions", Health::not_needed, "No haptic device hangs on the USB, so nobody must be let in."};
  std::string names, closed;
  std::error_code none;
  for (const HapticUnit& unit : units) {
    names += (names.empty() ? "" : ", ") + unit.name;
    for (const auto& node : unit.nodes)
      if (std::filesystem::exists(node, none) && !machine.may_use(node))
        closed += (closed.empty() ? "" : ", ") + node.string();
  }
  if (closed.empty()) return {"permissions", Health::ok, names + ": you may use every node."};
  return {"permissions", Health::missing, names + ": you may not use " + closed + ".",
          std::string("molar doctor --udev-rules | sudo tee ") + kUdevRulesFile +
              " && sudo udevadm control --reload && sudo udevadm trigger, then plug it in again."};
}

}  // namespace app
