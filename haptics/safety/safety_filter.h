// The last stage before the device: no force or torque that is not finite, none above the limit, none that the joints
// can not bear (safety/joint_torques), none that rises too fast. Any frame, torque about the handle; N, N mm, s. Servo
// thread; a few flops. Pure: state is the last wrench. The wrench never grows nor turns faster than the slew limit; it
// falls no faster either, but where something has tripped, or the magnitude limit itself falls: then it falls at once.
// Not a stability controller.
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

  /// What the hand may feel of `wanted`, which goes to zero when it is not finite. `jacobian_P_mm` as in HandSample.
  Delivered serve(const Wrench<calibration::Patient>& wanted_P, const SafetyLimits& limits, Fall fall, double dt_s,
                  const glm::dmat3& jacobian_P_mm = glm::dmat3(0.0)) noexcept;

 private:
  Wrench<calibration::Patient> last_P_;
};

}  // namespace haptics
