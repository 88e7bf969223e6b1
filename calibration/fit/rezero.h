// Updates a calibration after the arm was homed again or its base moved: three joint offsets and six pose parameters,
// maximum a posteriori, from about five touches (30 s). Everything else stays. Frame W; mm, rad. Any thread but the
// servo's; milliseconds. Source: reference/calibration 4.3.
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

/// One outlier of five touches is rejected; with more, after_rms_mm exceeds 0.6 mm: touch again. Throws
/// CalibrationError for fewer than 3 touches, all on a line, the same touch twice, or numbers not finite.
Rezero rezeroed(const MeasuredArm& arm, const TouchSet& touches);

}  // namespace calibration
