// A study as a report in the shape of the Common Industry Format (ISO/IEC 25062): goals, participants, context, tasks
// and rules, measures, results, problems, limits. One HTML file that asks for nothing (its policy forbids it). People
// are codes; no path, no name. Pure; any thread; milliseconds.
#pragma once

#include <string>
#include <vector>

#include "app/study/bundle/session_account.h"
#include "app/study/study_result.h"

namespace app {

struct CifReport {
  std::vector<SessionAccount> sessions;
  std::vector<StudyResult> results;  ///< one a questionnaire, tasks and problems in the first
  std::vector<std::string> remarks;  ///< what is left out or closed, and why
};

std::string cifPage(const CifReport& report);

}  // namespace app
