#include "app/doctor/checks.h"
#include "app/doctor/haptic_usb.h"
#include "app/text/list.h"

namespace app {

Finding checkPermissions(const Machine& machine) {
  const std::vector<HapticUnit> units = hapticUnits(machine);
  if (units.empty())
    return {"permissions", Health::not_needed, "No haptic device hangs on the USB, so nobody must be let in."};
  std::vector<std::string> closed;
  std::error_code none;
  for (const HapticUnit& unit : units)
    for (const auto& node : unit.nodes)
      if (std::filesystem::exists(node, none) && !machine.may_use(node)) closed.push_back(node.string());
  const std::string names = joined(units, &HapticUnit::name);
  if (closed.empty()) return {"permissions", Health::ok, names + ": you may use every node."};
  return {"permissions", Health::missing, names + ": you may not use " + joined(closed) + ".",
          std::string("molar doctor --udev-rules | sudo tee ") + kUdevRulesFile +
              " && sudo udevadm control --reload && sudo udevadm trigger, then plug it in again."};
}

}  // namespace app
