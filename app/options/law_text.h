// Force laws and their parameters as people name them: on the command line, in files, in answers. By the one table of
// haptics/contact/law_parameters. Start-up and, for files read anew while running, the frame loop.
#pragma once

#include <map>
#include <string>

#include "app/options/settings_text.h"
#include "haptics/contact/law_settings.h"

namespace app {

/// "agus, forssim, …"
std::string lawNames();
std::string lawName(haptics::LawKind law);

/// Throws UsageError that lists the names there are; `where` says what was read.
haptics::LawKind lawNamed(const std::string& name, const std::string& where = "--law ");

/// What may be set of the law in force, what every law obeys included: key, range, unit, and where in `law` it lives.
std::map<std::string, Setting> parametersOf(haptics::LawSettings& law);

}  // namespace app
