// The rehearsal itself: patient, hand, servo and pictures joined, from the first frame to the summary.
// Main thread. Runs until the time is over, the window is closed, Esc, or an interrupt; whatever ends it, the force
// goes to zero first and the recording is closed.
#pragma once

#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// The program's answer. Throws what its parts throw before anything runs. Prints the summary on stdout, or, where a
/// procedure leads, on stderr.
[[nodiscard]] int rehearse(RehearsalPlan plan);

}  // namespace app
