// That a rehearsal was an assessment, as an event of a recording: at its start, and where help was asked for and
// refused. Plain words; any thread.
#pragma once

#include <string_view>

namespace app {

/// Kind of these events.
inline constexpr char kAssessmentEvent[] = "assessment";

/// Of the first, and to the surgeon.
inline constexpr std::string_view kAssessmentRules =
    "no coach, no clearances in view, no undo, no plan, steps in any order, everything recorded";

/// Of the others begin with it.
inline constexpr std::string_view kHelpRefused = "asked for and refused: ";

}  // namespace app
