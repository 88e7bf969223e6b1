// Force and erosion laws, their parameters and the spindle's as people name them: on the command line, in files, in
// answers. By the tables of haptics/contact/law_parameters, haptics/bone/erosion and haptics/tool/spindle. Start-up
// and, for files read anew while running, the frame loop.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options/settings_text.h"
#include "haptics/bone/erosion.h"
#include "haptics/contact/law_settings.h"
#include "haptics/tool/spindle.h"

namespace app {

/// "agus, forssim, …"
std::string lawNames();
std::string lawName(haptics::LawKind law);
/// For the command line to choose from.
std::vector<std::string> erosionNames();
std::string erosionName(haptics::ErosionKind law);

/// Throws UsageError that lists the names there are; `where` says what was read.
haptics::LawKind lawNamed(const std::string& name, const std::string& where = "--law ");

/// What may be set of the law in force, what every law obeys included: key, range, unit, and where it lives.
std::map<std::string, Setting> parametersOf(haptics::LawSettings& law);
std::map<std::string, Setting> parametersOf(haptics::ErosionSettings& erosion);
std::map<std::string, Setting> parametersOf(haptics::SpindleSettings& spindle);

/// For --help: every erosion law with its formula, and every key with its unit.
std::string erosionHelp();

}  // namespace app
