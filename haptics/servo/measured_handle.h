// The handle's pose by the measured arm: the sensors' angles corrected, the pose from them. Velocity and Jacobian stay
// the driver's: the correction changes them by 1 to 2 % (reference/calibration 6.1), and the driver makes its motor
// torques with its own Jacobian. Without an arm, or for a device without angles, everything is the driver's. Frame D of
// the measured X_WD; mm, rad. Servo thread; no allocation, about 0.3 us a call. The arm is fixed for life.
#pragma once

#include <optional>

#include "calibration/arm/arm_correction.h"
#include "haptics/device/haptic_device.h"

namespace haptics {

class MeasuredHandle {
 public:
  /// Throws DeviceError if the arm is not finite.
  explicit MeasuredHandle(const std::optional<calibration::MeasuredArm>& arm);

  /// A state that lost its angles keeps the last pose and is not fresh: the driver's pose is millimetres off.
  HandleState corrected(HandleState state) noexcept;

 private:
  std::optional<calibration::MeasuredArm> arm_;
  std::optional<calibration::Pose<calibration::Device, calibration::Handle>> last_DH_;
};

}  // namespace haptics
