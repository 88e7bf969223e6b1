// One session of a study as a report needs it: who by code, what was allowed, under which conditions it was recorded,
// which tasks with which rules it had. From the event log, the template and the recording in its folder, none of which
// is changed. Start-up; some ms, the ticks are not read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/study/session_log.h"
#include "app/study/study_folder.h"

namespace app {

struct TaskAccount {
  std::string id, say, success, fail;
  double time_box_s = 0.0;
};

struct SessionAccount {
  StudySession session;
  std::string group, evaluator;
  std::map<std::string, bool> consent;  ///< by stream, the newest word
  std::string goal;                     ///< title of the template
  std::string case_name;
  std::vector<TaskAccount> tasks;
  /// Where there is no recording, why.
  std::string program, calibration, conditions;
  bool is_verified = false, rules_hold = false;
};

/// `events`: its log. Throws LoadError: the template is no TOML.
SessionAccount accountOf(const std::string& study, const StudySession& session, const std::vector<LogEvent>& events);

}  // namespace app
