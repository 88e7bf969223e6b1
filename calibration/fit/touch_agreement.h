// Outlier rejection: the touches that agree on one arm. First by a rigid registration of two thirds, then by the
// prediction of an arm fitted to those, which can also restore touches. Detects mirrored images, where the touches fit
// their mirror image and no pose. Frame W, mm. Deterministic. Any thread but the servo's; some milliseconds. Source:
// reference/calibration 3.1 (a direct fit of few touches follows the outlier), 3.3.
#pragma once

#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/touches.h"

namespace calibration {

struct TouchAgreement {
  ArmStart start;                  ///< from the rigid registration
  std::vector<std::size_t> which;  ///< indices of the agreeing touches, ascending
  int asked = 0;                   ///< touches marked used; the others of them are outliers
  /// The targets lie in a plane and the stylus would come from behind the screen, or a few touches fit their mirror
  /// image slightly better.
  bool may_be_mirrored = false;
};

/// Throws CalibrationError: mirrored, or no pose of the arm explains two thirds. Requires checkTouches.
TouchAgreement touchAgreement(const TouchSet& set);

}  // namespace calibration
