// Erosion laws, their parameters and the spindle's as people name them, by the tables of haptics/bone/erosion and
// haptics/tool/spindle. Start-up only.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options/settings_text.h"
#include "haptics/bone/erosion.h"
#include "haptics/tool/spindle.h"

namespace app {

/// For the command line to choose from.
std::vector<std::string> erosionNames();

/// What may be set of the law in force, what every law obeys included: key, range, unit, and where it lives.
std::map<std::string, Setting> parametersOf(haptics::ErosionSettings& erosion);
std::map<std::string, Setting> parametersOf(haptics::SpindleSettings& spindle);

/// For --help: every law with its formula, and every key with its unit.
std::string erosionHelp();

}  // namespace app
