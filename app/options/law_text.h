// Names and parameters of force laws, erosion laws and spindle, from the tables of haptics/contact/law_parameters,
// haptics/bone/erosion and haptics/tool/spindle. Main thread.
#pragma once

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
std::vector<std::string> erosionNames();
std::string erosionName(haptics::ErosionKind law);

/// Throws UsageError listing the names; `where`: the option or file and key.
haptics::LawKind lawNamed(const std::string& name, const std::string& where = "--law ");

/// Settings of the current law, those of every law included.
SettingMap parametersOf(haptics::LawSettings& law);
SettingMap parametersOf(haptics::ErosionSettings& erosion);
SettingMap parametersOf(haptics::SpindleSettings& spindle);

/// For --help: erosion laws with formulae, keys with units.
std::string erosionHelp();

}  // namespace app
