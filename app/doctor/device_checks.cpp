#include <algorithm>

#include "app/doctor/checks.h"
#include "app/doctor/haptic_usb.h"
#include "app/text/list.h"
#include "haptics/device/pedal/found_pedal.h"

namespace app {
namespace {

bool runs(const Machine& machine, std::string_view name) {
  for (const auto& entry : entriesOf(machine.proc)) {
    const std::string number = entry.filename().string();
    if (number.find_first_not_of("0123456789") == std::string::npos && firstLine(entry / "comm") == name) return true;
  }
  return false;
}

/// A udev rule excludes 3D Systems' units.
bool isExcludedByRule(const Machine& machine) {
  for (const auto& file : entriesOf(machine.etc / "udev/rules.d"))
    for (const std::string& line : linesOf(file))
      if (!line.starts_with("#") && line.find("2988") != std::string::npos &&
          line.find("ID_MM_DEVICE_IGNORE") != std::string::npos)
        return true;
  return false;
}

}  // namespace

Finding checkPedal(const Machine& machine) {
  const auto pedals = haptics::findPedals({machine.sys / "class/input", machine.dev / "input"});
  if (pedals.empty())
    return {"pedal", Health::not_needed, "No foot pedal or joystick: the space bar or a button on the device drills."};
  const haptics::FoundPedal& first = pedals.front();
  const std::string name = first.traits.name + " (" + first.path.string() + ")";
  if (machine.may_use(first.path)) return {"pedal", Health::ok, name + " drills."};
  return {"pedal", Health::warn, name + " is there, and you may not read it.",
          "molar doctor --udev-rules prints the rules that let you."};
}

Finding checkPermissions(const Machine& machine) {
  const std::vector<HapticUnit> units = hapticUnits(machine);
  if (units.empty())
    return {"permissions", Health::not_needed, "No haptic device is on the USB, so no permission is needed."};
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

Finding checkModemManager(const Machine& machine) {
  if (!runs(machine, "ModemManager"))
    return {"modem-manager", Health::ok, "ModemManager does not run, so it takes no device's port."};
  if (isExcludedByRule(machine))
    return {"modem-manager", Health::ok, "ModemManager runs and a udev rule keeps it off 3D Systems units."};
  const std::vector<HapticUnit> units = hapticUnits(machine);
  const bool would_take =
      std::ranges::any_of(units, [](const HapticUnit& unit) { return unit.isTouch() && unit.is_serial; });
  return {"modem-manager", would_take ? Health::missing : Health::warn,
          would_take ? "ModemManager runs and takes the serial port of your 3D Systems unit for a modem."
                     : "ModemManager runs and would take a serial 3D Systems unit for a modem.",
          std::string("molar doctor --udev-rules | sudo tee ") + kUdevRulesFile +
              ", or sudo systemctl disable --now ModemManager."};
}

Finding checkVendorLibrary(const Machine& machine, const std::string& why_unavailable) {
  const std::vector<HapticUnit> units = hapticUnits(machine);
  const bool is_needed = std::ranges::any_of(units, &HapticUnit::isTouch);
  if (!why_unavailable.empty())
    return {"openhaptics", is_needed ? Health::missing : Health::not_needed, why_unavailable + ".",
            is_needed ? "Then run Touch_Setup, which finds the unit." : "Only a Phantom or Touch needs it."};
  return {"openhaptics", Health::ok, "OpenHaptics by 3D Systems can be loaded."};
}

}  // namespace app
