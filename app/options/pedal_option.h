// `--pedal`: which pedal, and which of its switches means what, as people write it.
//   auto · none · /dev/input/event4 · a part of its name, then commas: auto,KEY_B=drill,-ABS_Z=irrigation
//   FILE.toml: device = "…", table [actions] of switch = "action", table [thresholds] of axis = 0.15 to 0.95
// Actions, called as the controls are (controls/control.h): drill, while it is held; irrigation, undo, tool. Switches
// by the kernel's names, as evtest shows them. Start-up only.
#pragma once

#include <optional>
#include <string>

#include "haptics/device/pedal/foot_pedal.h"

namespace app {

inline constexpr const char* kPedalHelp =
    "Pedal: auto, none, a path or a part of its name; then SWITCH=ACTION after commas (KEY_B=drill); or FILE.toml";

/// None for "none". Throws UsageError for an action, a switch or a file that can not be used.
std::optional<haptics::PedalChoice> pedalFrom(const std::string& text);

}  // namespace app
