// Whether a case lies where the workstation can serve it: near the virtual screen for a moving head, and within the
// arm's reach with a margin. The region is a box of 60 x 50 x 40 mm around the tooth at work, as far as it was scanned.
// Sources: reference/calibration 1.4, 5. Frames P and W, mm. Pure; start-up only, under 0.2 s.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/patient.h"
#include "calibration/rig.h"

namespace app {

/// Largest distance of the region from the virtual screen's plane.
double farthestOffScreen_mm(const calibration::Rig& rig, const assets::Patient& patient);

struct Reach {
  int corners_out = 0;  ///< of 8: not reached, or nearer than 5 mm to a limit of the arm, or a gimbal beyond 60 degrees
  struct Shift {
    glm::dvec3 by_W_mm{0.0};
    double turn_deg = 0.0;  ///< about the vertical through the tooth at work
  };
  std::optional<Shift> suggestion;  ///< the smallest within 15 mm and 20 degrees that brings all within reach
};
/// With the arm of the rig, else the model's.
Reach reachOf(const calibration::Rig& rig, const assets::Patient& patient, const calibration::PhantomGeometry& arm);

/// Warnings for the user before the start, a line each. `arm_model`: key of phantom_models, else no arm is checked.
/// `eye_sd_mm` as in the rig's record: 2 is a tracked head.
std::vector<std::string> caseRemarks(const calibration::Rig& rig, const assets::Patient& patient, double eye_sd_mm,
                                     const std::string& arm_model);

}  // namespace app
