// Registration of the hand rest: three touches of known marks give its pose, three more verify it. A rest drawn more
// than 2 mm off misleads the hand (reference/calibration 5). Frame W and the rest's own; mm. Any thread; microseconds.
#pragma once

#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace calibration {

struct MarkTouch {
  glm::dvec3 mark_mm{0.0};  ///< on the rest
  Point<World> touched_W;
};

struct RestRegistration {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< X_W,rest
  glm::dvec3 translation_mm{0.0};
  double fre_rms_mm = 0.0;  ///< over the fitted marks
  double worst_mm = 0.0;    ///< over the verifying marks

  Point<World> position_W(const glm::dvec3& mark_mm) const { return {rotation * mark_mm + translation_mm}; }
};
inline constexpr double kMaxRestError_mm = 2.0;

/// Throws CalibrationError for fewer than three marks, marks on a line, numbers not finite, or distances that differ
/// from the marks' by more than 3 mm (wrong order, another rest).
RestRegistration registerRest(const std::vector<MarkTouch>& fitted_to, const std::vector<MarkTouch>& verified_by);

}  // namespace calibration
