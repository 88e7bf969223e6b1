// The doctor's findings as aligned text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "app/doctor/finding.h"
#include "app/text/terminal_format.h"

namespace app {

/// How many report something missing.
int missingCount(const std::vector<Finding>& findings);

std::string asText(const std::vector<Finding>& findings, const TerminalFormat& look);
/// {"checks": [{"id", "state", "sentence", "next_step"}], "missing": n}
std::string asJson(const std::vector<Finding>& findings);

}  // namespace app
