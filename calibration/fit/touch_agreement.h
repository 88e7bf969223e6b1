// Which touches tell of the same arm: those that slipped, or are of another target, are named before anything counts.
// First by a rigid lay that two thirds agree on, then by what an arm fitted to those foretells of each, and it may take
// back what the first look left out. A image that is mirrored is found here: the touches then fit their own mirror
// image and no pose. Frame W, mm. Deterministic. Any thread but the servo's; some milliseconds.
// Source: reference/calibration 3.1 (without a first look, a fit of few touches chases the wild one), 3.3.
#pragma once

#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/touches.h"

namespace calibration {

struct TouchAgreement {
  ArmStart start;                  ///< from the rigid lay
  std::vector<std::size_t> which;  ///< indices of the touches that agree, rising
  int asked = 0;                   ///< touches marked used: the rest of them are outliers
  /// The targets lie in a plane and the stylus would come from behind the screen, or so few touches fit their mirror
  /// image a little better: a mirrored image would look just so.
  bool may_be_mirrored = false;
};

/// Throws CalibrationError: mirrored, or no pose of the arm explains two thirds of them. They have passed checkTouches.
TouchAgreement touchAgreement(const TouchSet& set);

}  // namespace calibration
