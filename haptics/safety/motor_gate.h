// The last gate before the motors and the only source of a MotorCommand with force: finite, within the device's peak
// force, torque and joint torques, and zero once shut. Frame D, about the handle; N, N mm. admit(): servo thread, a few
// dozen flops; shut(): any thread, final. Stateless apart from that, unlike the safety layer.
#pragma once

#include <atomic>

#include "haptics/device/haptic_device.h"

namespace haptics {

class MotorGate {
 public:
  explicit MotorGate(const DeviceCapabilities& device);

  /// `jacobian_D_mm` as in HandleState. Motors off, and no force, when the wrench or the Jacobian is not finite.
  MotorCommand admit(const Wrench<calibration::Device>& requested_D, const glm::dmat3& jacobian_D_mm,
                     bool motors_on) const noexcept;

  void shut() noexcept { shut_.store(true); }
  bool isShut() const { return shut_.load(std::memory_order_relaxed); }

 private:
  double peak_force_N_, peak_torque_Nmm_;
  glm::dvec3 peak_joint_torque_Nmm_;
  std::atomic<bool> shut_{false};
};

}  // namespace haptics
