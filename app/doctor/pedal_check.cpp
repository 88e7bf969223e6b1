#include "app/doctor/checks.h"
#include "haptics/device/pedal/found_pedal.h"

namespace app {

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

}  // namespace app
