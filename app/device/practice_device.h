// The device a technician practises on: `practice:SCENARIO[:SEED]`, an Omni in numbers whose arm is as untrue as real
// ones are and stands where nobody has measured it. Scenarios A to G: calibration/synthetic/synthetic_rig. Start-up
// only.
#pragma once

#include <optional>
#include <string>

#include "calibration/synthetic/synthetic_rig.h"

namespace app {

/// Its truth, from its address; none for another address. Throws UsageError for a scenario or seed that is none.
std::optional<calibration::SyntheticRig> practiceRig(const std::string& address);

}  // namespace app
