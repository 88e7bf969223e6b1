// The device for practising a calibration: `practice:SCENARIO[:SEED]`, a simulated Omni with the errors of a real arm,
// at an unmeasured position. Scenarios A to G: calibration/synthetic/synthetic_rig. Start-up only.
#pragma once

#include <optional>
#include <string>

#include "calibration/synthetic/synthetic_rig.h"

namespace app {

/// Its true rig, from its address; none for another address. Throws UsageError for a wrong scenario or seed.
std::optional<calibration::SyntheticRig> practiceRig(const std::string& address);

}  // namespace app
