// Whether a case can tell a measure at all: a rule that names one that it cannot tell would never hold, silently. By
// the same conditions as outcome.h, clearance_measures.h and near_work.h. Pure; any thread; microseconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/session/measures/session_case.h"
#include "app/session/session_start.h"

namespace app {

/// Why no rehearsal of it will ever have a value; none: it can, once something was done. Other ids than those of S1 to
/// S5 and O1 to O11: none.
std::optional<std::string> whyNeverTold(std::string_view id, const StoredStart& start, const SessionCase& about);

}  // namespace app
