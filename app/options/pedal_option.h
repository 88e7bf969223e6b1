// `--pedal`: the pedal and the actions of its switches.
//   auto · none · /dev/input/event4 · a part of its name, then commas: auto,KEY_B=drill,-ABS_Z=irrigation
//   FILE.toml: device = "…", table [actions] of switch = "action", table [thresholds] of axis = 0.15 to 0.95
// Actions have the names of the controls (controls/control.h): drill (while held), irrigation, undo, tool. Switches
// have the kernel's names, as evtest shows them. Start-up only.
#pragma once

#include <optional>
#include <string>

#include "haptics/device/pedal/foot_pedal.h"

namespace app {

inline constexpr const char* kPedalHelp =
    "Pedal: auto, none, a path or a part of its name; then SWITCH=ACTION after commas (KEY_B=drill); or FILE.toml";

/// None for "none". Throws UsageError for an unknown action or switch or an invalid file.
std::optional<haptics::PedalChoice> pedalFrom(const std::string& text);
/// Throws UsageError if a pedal that was named is not there, with those that are. "auto" waits for one.
void refuseUnlessPlugged(const haptics::PedalChoice& choice);

}  // namespace app
