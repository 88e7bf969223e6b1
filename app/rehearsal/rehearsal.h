// One rehearsal: patient, device, servo and views, from the first frame to the summary. Main thread. Runs until its
// time is over, the window is closed, Esc, a procedure's end, or an interrupt. However it ends, the force goes to zero
// first and the recording is closed.
#pragma once

#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// Returns the exit status: 1 if a recording was requested and is not whole. Prints the summary on stdout, with a
/// procedure on stderr. Throws what opening devices, displays and recordings throws.
[[nodiscard]] int rehearse(RehearsalPlan plan);

/// A signal to end the program ended the last rehearsal.
bool wasInterrupted();

}  // namespace app
