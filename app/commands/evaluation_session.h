// One session of a cooperative evaluation, phase by phase: checks, consent, warm-up, tasks in a rehearsal, debrief,
// questionnaires, close. Main thread; as long as the session.
#pragma once

#include <string>

#include "app/commands/rehearse_options.h"

namespace app {

struct EvaluateOptions {
  std::string study_template, participant, group, evaluator = "E1", out, script, page, microphone = "default";
  bool share = false;
  RehearseOptions rehearsal;
};

/// The exit status: 0 whole, 1 interrupted, not allowed, or not verified. Throws UsageError for what contradicts
/// itself, and what template, script, patient, rig and device throw.
int runEvaluation(EvaluateOptions& options);

}  // namespace app
