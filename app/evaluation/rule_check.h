// Whether the rules fire in the recording where they fired live: the same ticks and commands, the same code. Any
// thread but the servo; a third of a second for a minute, and where rules need the bone the servo's steps again.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/study/session_log.h"

namespace app {

struct RuleCheck {
  std::size_t fired = 0;             ///< live
  std::vector<std::string> deviate;  ///< one line each
};

/// `events`: of the session. Throws SessionError: the recording cannot be read.
RuleCheck checkRules(const StudyTemplate& study, const std::vector<LogEvent>& events, const std::string& recording);

}  // namespace app
