// The last stage before the device: no force or torque that is not finite, above its limit or beyond the joints
// (safety/joint_torques), none that rises too fast. The wrench never grows nor rotates faster than the slew limit; it
// falls no faster either, except at once after a trip or when the limit itself falls. Any frame, torque about the
// handle; N, N mm, s. State: the last wrench. Servo thread; a few flops. Not a stability controller.
#pragma once

#include "calibration/geometry/frames.h"
#include "haptics/safety/fault.h"
#include "haptics/safety/safety_limits.h"
#include "haptics/wrench.h"

namespace haptics {

class SafetyFilter {
 public:
  struct Delivered {
    Wrench<calibration::Patient> wrench_P;
    Fault faults = Fault::none;  ///< clamped, joints, slewed, bad_force
  };

  enum class Fall { at_slew, at_once };

  /// A wrench that is not finite counts as zero. `jacobian_P_mm` as in HandSample.
  Delivered serve(const Wrench<calibration::Patient>& requested_P, const SafetyLimits& limits, Fall fall, double dt_s,
                  const glm::dmat3& jacobian_P_mm = glm::dmat3(0.0)) noexcept;

 private:
  Wrench<calibration::Patient> last_P_;
};

}  // namespace haptics
