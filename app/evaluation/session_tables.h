// The tables of one session, made from its event log, in the form that `molar study` reads: tasks.csv, problems.csv,
// answers-ID.csv of each questionnaire that was answered. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/study/session_log.h"

namespace app {

struct SessionTable {
  std::string name, text;  ///< "tasks.csv"
};

/// `folder` names the session in links to moments: "P07-1 3:41".
std::vector<SessionTable> sessionTables(const StudyTemplate& study, const std::vector<LogEvent>& events,
                                        const std::string& folder);

}  // namespace app
