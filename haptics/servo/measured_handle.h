// Where the handle is by the arm as it was measured, not as its driver believes it: the sensors' angles corrected, the
// place and turn of the handle from them. Velocity and Jacobian stay the driver's: the correction changes them by 1 to
// 2 % (reference/calibration 6.1), and the Jacobian is the one by which the driver makes its motors' torques. Without
// an arm, or of a device that tells no angles, everything is the driver's. Frame D of the measured X_WD; mm, rad.
// The servo's thread; no allocation, about 0.3 us a call. The arm is fixed for life: to change it, stop and make anew.
#pragma once

#include <optional>

#include "calibration/arm/arm_correction.h"
#include "haptics/device/haptic_device.h"

namespace haptics {

class MeasuredHandle {
 public:
  /// Throws DeviceError when the arm's numbers are not finite.
  explicit MeasuredHandle(const std::optional<calibration::MeasuredArm>& arm);

  /// A state that lacks the angles that were there before leaves the handle where it was, and is not fresh: between the
  /// driver's place and the corrected one lie millimetres.
  HandleState corrected(HandleState state) noexcept;

 private:
  std::optional<calibration::MeasuredArm> arm_;
  std::optional<calibration::Pose<calibration::Device, calibration::Handle>> last_DH_;
};

}  // namespace haptics
