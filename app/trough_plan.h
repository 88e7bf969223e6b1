// Where the buccal trough of a third-molar extraction lies on this patient's bone (product reference §3.1, step 4):
// a line on the bone surface beside the crown, from mesial to distal, and the direction the bur comes from.
// Found by casting rays onto the solid surface. Frame P, mm. Start-up only; milliseconds. For the scripted hand.
#pragma once

#include <optional>
#include <vector>

#include "assets/patient.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

struct TroughPlan {
  std::vector<calibration::Point<calibration::Patient>> surface_P;  ///< on the bone, mesial to distal, ~0.5 mm apart
  calibration::Vector<calibration::Patient> outward_P;              ///< unit, out of the bone towards the bur
};

/// None where no bone lies beside the crown, or the patient has no third molar.
std::optional<TroughPlan> planBuccalTrough(const assets::Patient& patient);

}  // namespace app
