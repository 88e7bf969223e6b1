// What is looked at before a session of an evaluation may begin: case, device, disk, recording, rules, rig. Red: it
// does not begin. Start-up only.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation/evaluation_course.h"
#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// `folder`: of the study; it need not be there yet. `voice`: words on what is recorded of it.
std::vector<Check> evaluationChecks(const RehearsalPlan& plan, const StudyTemplate& study, const std::string& folder,
                                    const std::string& voice);

}  // namespace app
