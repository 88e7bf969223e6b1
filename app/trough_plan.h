// Where the buccal trough of a third-molar extraction lies on this patient's bone: a line on the bone surface beside
// the crown, from mesial to distal, and the direction the bur comes from. Found by casting rays onto the solid surface.
// Start-up only; milliseconds. For the scripted hand, whose frame D is then the patient's P.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "haptics/device/simulated/scripted_hand.h"

namespace app {

/// None where no bone lies beside the crown, or the patient has no third molar.
std::optional<haptics::TroughPlan> planBuccalTrough(const assets::Patient& patient, double bur_radius_mm);

}  // namespace app
