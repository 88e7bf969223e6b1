// A calibration brought up to date after the arm was homed anew or its base was moved: three joint offsets and six
// parameters of the pose, as the most probable values given few touches (nine parameters, five touches, 30 s).
// Everything else stays. Frame W; mm, rad. Any thread but the servo's; milliseconds. Source: reference/calibration 4.3.
#pragma once

#include "calibration/fit/arm_fit.h"

namespace calibration {

struct Rezero {
  MeasuredArm arm;
  double before_rms_mm = 0.0, after_rms_mm = 0.0;  ///< over the touches used
  std::vector<Residual> residuals;                 ///< after
  double moved_mm = 0.0, turned_deg = 0.0;         ///< of the base
  std::array<double, 3> offset_change_deg{};
  int outliers = 0;
};

/// Of five touches one may slip; where more than one did, after_rms_mm says so: above 0.6 mm touch them again.
/// Throws CalibrationError for fewer than 3 touches, all on a line, the same touch twice, or parameters not finite.
Rezero rezeroed(const MeasuredArm& arm, const TouchSet& touches);

}  // namespace calibration
