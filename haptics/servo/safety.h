// The last word before the device: no force that is not finite, none above the limit, none that rises too fast. Wraps
// every backend, the simulated ones too. Any frame; N, s. Servo thread; a few flops. Pure: state is the last force.
// A change of force is never faster than the slew limit, with one exception: when the magnitude limit itself falls, the
// magnitude obeys at once. Not a stability controller.
#pragma once

#include "haptics/servo/safety_limits.h"
#include "haptics/servo/tick.h"

namespace haptics {

/// The limits as they are obeyed: a peak that is not a number >= 0 means no force at all, an unusable slew the default.
SafetyLimits sanitised(const SafetyLimits& limits);

class SafetyFilter {
 public:
  struct Served {
    calibration::Vector<calibration::Patient> force_P_N;
    Fault faults = Fault::none;  ///< clamped, slewed, bad_force
  };

  /// What the hand may feel of `wanted`. While `ramp_down`, or when `wanted` is not finite, the force goes to zero at
  /// the slew limit.
  Served serve(const calibration::Vector<calibration::Patient>& wanted_P_N, const SafetyLimits& limits, bool ramp_down,
               double dt_s) noexcept;

 private:
  glm::dvec3 last_N_{0.0};
};

}  // namespace haptics
