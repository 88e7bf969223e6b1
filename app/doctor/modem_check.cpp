#include <algorithm>

#include "app/doctor/checks.h"
#include "app/doctor/haptic_usb.h"

namespace app {
namespace {

bool runs(const Machine& machine, std::string_view name) {
  for (const auto& entry : entriesOf(machine.proc)) {
    const std::string number = entry.filename().string();
    if (number.find_first_not_of("0123456789") == std::string::npos && firstLine(entry / "comm") == name) return true;
  }
  return false;
}

/// Some rule tells it to leave 3D Systems' units alone.
bool isToldOff(const Machine& machine) {
  for (const auto& file : entriesOf(machine.etc / "udev/rules.d"))
    for (const std::string& line : linesOf(file))
      if (!line.starts_with("#") && line.find("2988") != std::string::npos &&
          line.find("ID_MM_DEVICE_IGNORE") != std::string::npos)
        return true;
  return false;
}

}  // namespace

Finding checkModemManager(const Machine& machine) {
  if (!runs(machine, "ModemManager"))
    return {"modem-manager", Health::ok, "ModemManager does not run, so it takes no device's port."};
  if (isToldOff(machine))
    return {"modem-manager", Health::ok, "ModemManager runs and is told to leave 3D Systems units alone."};
  const std::vector<HapticUnit> units = hapticUnits(machine);
  const bool would_take = std::ranges::any_of(
      units, [](const HapticUnit& unit) { return unit.maker == UnitMaker::systems_3d && unit.is_serial; });
  return {"modem-manager", would_take ? Health::missing : Health::warn,
          would_take ? "ModemManager runs and takes the serial port of your 3D Systems unit for a modem."
                     : "ModemManager runs and would take a serial 3D Systems unit for a modem.",
          std::string("molar doctor --udev-rules | sudo tee ") + kUdevRulesFile +
              ", or sudo systemctl disable --now ModemManager."};
}

}  // namespace app
