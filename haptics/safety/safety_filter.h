// The last word before the device: no force or torque that is not finite, none above the limit, none that rises too
// fast. Wraps every backend, the simulated ones too. Any frame, torque about the handle; N, N mm, s. Servo thread; a
// few flops. Pure: state is the last wrench. A change of force is never faster than the slew limit, with one exception:
// when the magnitude limit itself falls, the magnitude obeys at once. Not a stability controller.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/safety/fault.h"
#include "haptics/safety/safety_limits.h"
#include "haptics/wrench.h"

namespace haptics {

/// The limits as they are obeyed: a peak that is not a number >= 0 means nothing at all, an unusable slew the default.
SafetyLimits sanitised(const SafetyLimits& limits);

class SafetyFilter {
 public:
  struct Served {
    Wrench<calibration::Patient> wrench_P;
    Fault faults = Fault::none;  ///< clamped, slewed, bad_force
  };

  /// What the hand may feel of `wanted`. While `ramp_down`, or when `wanted` is not finite, it goes to zero at the slew
  /// limits.
  Served serve(const Wrench<calibration::Patient>& wanted_P, const SafetyLimits& limits, bool ramp_down,
               double dt_s) noexcept;

 private:
  Wrench<calibration::Patient> last_P_;
};

}  // namespace haptics
