// Settings of a Command by key: from `--set key=value`, from the tables of a TOML file, and the differences of two
// commands as text. Ranges come from the tables of haptics. Main thread: start-up, and the frame loop for files read
// again; a stability check costs up to a millisecond.
#pragma once

#include <string>
#include <vector>

#include "app/options/settings_text.h"
#include "haptics/servo/command.h"

namespace assets {
class TomlReader;
}

namespace app {

/// Of the command's force law, erosion law, spindle and safety limits.
SettingMap settingsOf(haptics::Command& command);

/// Applies `key=value` texts. `worn` sets force law and erosion alike, as both describe the same bur.
void applyTo(haptics::Command& command, const std::vector<std::string>& texts);

/// Tables: [law] and [erosion] with name and parameters, [spindle], [tool] head and shaft, [safety]; missing keys keep
/// the value of `base`. Throws LoadError with file, line and key.
haptics::Command commandFromToml(assets::TomlReader& keys, const haptics::Command& base);

/// Refuses values beyond the servo's limits, which it would clamp.
void refuseBeyondServoLimits(const haptics::Command& command);

/// Refuses a law that does not admit the head.
void refuseUnlessAdmitted(const haptics::Command& command);

/// The same, and refuses a law stiffer than a device of this damping renders passively at this rate
/// (haptics/contact/law_limits), naming the nearest admissible value.
void refuseUnlessStable(const haptics::Command& command, double device_damping_Ns_per_mm, double rate_Hz);

/// The command with the law's gains lowered until it passes that check, for changing laws while running. Throws
/// UsageError if that is not possible.
haptics::Command loweredUntilStable(haptics::Command command, double device_damping_Ns_per_mm, double rate_Hz);

/// "[law] stiffness_N_per_mm 0.8 -> 1 N/mm": a line per difference, except serial, drill lock, irrigation and undo.
std::vector<std::string> changesBetween(const haptics::Command& before, const haptics::Command& after);

/// Damping of a Touch-class device in a light grip (reference/physics 2.5), for use without a device.
inline constexpr double kUsualDeviceDamping_Ns_per_mm = 0.002;

}  // namespace app
