// What a session of an evaluation begins with: what contradicts itself is refused, and the warm-up's rehearsal follows
// from the session's. Start-up only.
#pragma once

#include "app/commands/evaluation_session.h"
#include "app/debrief/debrief_plan.h"
#include "app/evaluation/study_template.h"
#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// Throws UsageError.
void refuseUnlessFits(const EvaluateOptions& options, const StudyTemplate& study);

/// What the template says of case, operation and tools.
void takeCase(RehearseOptions& options, const StudyTemplate& study);

/// A block at the same place with the same hand; nothing of it is recorded.
RehearseOptions warmUpOptions(const RehearseOptions& main, const StudyTemplate& study);

/// The recording in the surgeon's display, as the rehearsal was: layers, stereo, monitor.
DebriefPlan debriefPlanOf(const RehearseOptions& main, const RehearsalPlan& plan);

}  // namespace app
