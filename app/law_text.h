// Force laws and their parameters as people name them: on the command line, in files, in answers. Start-up and, for
// files read anew while running, the frame loop.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/settings_text.h"
#include "haptics/contact/law.h"

namespace app {

std::vector<std::string> lawNames();
std::string lawName(haptics::LawKind law);

/// Throws UsageError that lists the names there are.
haptics::LawKind lawNamed(const std::string& name, const std::string& where = "--law");

/// What may be set of the law in force: key, range, unit, and where in `law` it lives.
std::map<std::string, Setting> parametersOf(haptics::LawSettings& law);

}  // namespace app
