// The coach's rules as TOML: the shipped ones, which are part of the program, and a supervisor's own file. Strict:
// every wrong or unknown key is refused in one line with file, line and key. Start-up only.
#pragma once

#include <string>

#include "app/procedure/coach/coach.h"

namespace app {

/// The file as it is shipped, to be copied and edited.
std::string shippedCoachText();
/// `where` names the file. Throws assets::LoadError.
CoachRules coachRulesFromToml(const std::string& text, const std::string& where);
/// Empty: the shipped ones. Throws UsageError for a name that does not end in .toml, LoadError.
CoachRules coachRulesOf(const std::string& file);

}  // namespace app
