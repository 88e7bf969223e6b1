// A rehearsal as the options of `molar rehearse` ask for it: device and rig chosen, the patient prepared and placed,
// the recording named. For every command that rehearses. Main thread; seconds, most of them for the patient.
#pragma once

#include <optional>

#include "app/commands/rehearse_options.h"
#include "app/rehearsal/rehearsal_plan.h"

namespace app {

/// Takes the plan out of the options; a device that is open in it already is used. None: left while the patient was
/// prepared. Throws UsageError for what contradicts itself, and what opening patient, rig and device throws.
std::optional<RehearsalPlan> composeRehearsal(RehearseOptions& options);

}  // namespace app
