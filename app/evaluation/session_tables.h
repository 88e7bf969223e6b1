// The tables of one session by its template (app/study/log_tables.h). Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/study/log_tables.h"

namespace app {

/// `folder` names the session in links to moments: "P07-1 3:41".
std::vector<SessionTable> sessionTables(const StudyTemplate& study, const std::vector<LogEvent>& events,
                                        const std::string& folder);

}  // namespace app
