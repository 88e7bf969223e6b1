// Carries the force over from what it was to what it is to be when the law, the tool or the place changes at once: the
// difference fades out in 40 ms, without a corner at either end, so that no switch is felt as a knock and a tool that
// finds itself in bone is taken hold of gently. Frame P, about the handle. Servo thread; a few flops. The course in
// time does not depend on the tick. Not a limit (safety/safety_filter): 3.3 N fade at no more than 124 N/s.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/wrench.h"

namespace haptics {

class Transition {
 public:
  static constexpr double kDuration_s =
      0.04;  ///< shorter than a hand reacts (about 0.1 s), longer than it feels a knock

  /// `switched`: what is wanted now is not what was wanted before, moved on.
  Wrench<calibration::Patient> follow(const Wrench<calibration::Patient>& wanted, bool switched, double dt_s) noexcept {
    if (switched) {
      difference_ = last_ - wanted;
      left_s_ = kDuration_s - dt_s;
    } else {
      left_s_ = left_s_ > dt_s ? left_s_ - dt_s : 0.0;
    }
    const double u = left_s_ / kDuration_s;
    last_ = left_s_ > 0.0 ? wanted + (u * u * (3.0 - 2.0 * u)) * difference_ : wanted;
    return last_;
  }

 private:
  Wrench<calibration::Patient> last_, difference_;
  double left_s_ = 0.0;
};

}  // namespace haptics
