// Fades the force over when law, tool or position change at once: the difference fades out in 40 ms with a smooth step,
// so that no switch is felt as a knock and a tool that finds itself in bone is loaded gently. Frame P, about the
// handle. Servo thread; a few flops. The course in time does not depend on the tick: 3.3 N fade at no more than 124
// N/s.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/wrench.h"

namespace haptics {

class Transition {
 public:
  static constexpr double kDuration_s = 0.04;  ///< below the reaction time (about 0.1 s), above what is felt as a knock

  /// `switched`: `requested` does not continue the last one.
  Wrench<calibration::Patient> update(const Wrench<calibration::Patient>& requested, bool switched,
                                      double dt_s) noexcept {
    if (switched) {
      difference_ = last_ - requested;
      left_s_ = kDuration_s - dt_s;
    } else {
      left_s_ = left_s_ > dt_s ? left_s_ - dt_s : 0.0;
    }
    const double u = left_s_ / kDuration_s;
    last_ = left_s_ > 0.0 ? requested + (u * u * (3.0 - 2.0 * u)) * difference_ : requested;
    return last_;
  }

 private:
  Wrench<calibration::Patient> last_, difference_;
  double left_s_ = 0.0;
};

}  // namespace haptics
