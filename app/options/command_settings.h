// Everything people may set of a Command, by one name each: `--set key=value` on the command line, tables of a TOML
// file, and what changed between two of them in words. Ranges are those of the servo's own tables. Start-up and, for
// files read anew while running, the frame loop; a look at what a device holds costs up to a millisecond.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options/settings_text.h"
#include "haptics/servo/command.h"

namespace assets {
class TomlReader;
}

namespace app {

/// Of the laws in force: law, erosion, spindle, limits.
std::map<std::string, Setting> settingsOf(haptics::Command& command);

/// Applies `key=value` texts. One bur is as dull to the hand as to the bone: `worn` is one setting.
void applyTo(haptics::Command& command, const std::vector<std::string>& texts);

/// [law] name and its parameters, [erosion] name and its, [spindle], [tool] head and shaft, [safety]; what the file
/// leaves out is as in `base`. Throws LoadError with file, line and key.
haptics::Command commandFromToml(assets::TomlReader& keys, const haptics::Command& base);

/// Refuses a law that does not admit the head.
void refuseUnlessAdmitted(const haptics::Command& command);

/// The same, and refuses a law that is stiffer than a device of this damping holds at this rate
/// (passivity, haptics/contact/law_limits): with the reason and the nearest value that is allowed.
void refuseUnlessStable(const haptics::Command& command, double device_damping_Ns_per_mm, double rate_Hz);

/// The command with the law's gains lowered until that device holds it; for switching laws in the middle of work.
/// Throws UsageError where lowering does not help.
haptics::Command loweredUntilStable(haptics::Command command, double device_damping_Ns_per_mm, double rate_Hz);

/// "[law] stiffness_N_per_mm 0.8 -> 1 N/mm", a line for everything that differs; serial, drill lock, irrigation and
/// undo aside.
std::vector<std::string> changesBetween(const haptics::Command& before, const haptics::Command& after);

/// Damping of a Touch-class device in a light grip (reference/physics 2.5): where no device is known.
inline constexpr double kUsualDeviceDamping_Ns_per_mm = 0.002;

}  // namespace app
