#include "haptics/safety/motor_gate.h"

#include <cmath>

#include "haptics/safety/safety_limits.h"

namespace haptics {
namespace {

double usable(double peak) { return std::isfinite(peak) && peak > 0.0 ? peak : 0.0; }

/// 1, or what shortens `length` to `peak`.
double shareWithin(double peak, double length) { return length > peak ? peak / length : 1.0; }

}  // namespace

MotorGate::MotorGate(const DeviceCapabilities& device)
    : peak_force_N_(usable(device.peak_force_N)),
      peak_torque_Nmm_(usable(device.peak_torque_Nmm)),
      peak_joint_torque_Nmm_(sanitisedJointPeak_Nmm(device.peak_joint_torque_Nmm.x),
                             sanitisedJointPeak_Nmm(device.peak_joint_torque_Nmm.y),
                             sanitisedJointPeak_Nmm(device.peak_joint_torque_Nmm.z)) {}

MotorCommand MotorGate::admit(const Wrench<calibration::Device>& requested_D, const glm::dmat3& jacobian_D_mm,
                              bool motors_on) const noexcept {
  if (!motors_on || isShut()) return {};
  glm::dvec3 force_N = requested_D.force_N.xyz, torque_Nmm = requested_D.torque_Nmm.xyz;
  const double length_N = glm::length(force_N), length_Nmm = glm::length(torque_Nmm);
  const glm::dvec3 joints_Nmm = glm::abs(glm::transpose(jacobian_D_mm) * force_N);
  if (!std::isfinite(length_N) || !std::isfinite(length_Nmm) || !std::isfinite(glm::length(joints_Nmm))) return {};

  // The whole force is scaled, so that its direction stays.
  double share = shareWithin(peak_force_N_, length_N);
  for (int joint = 0; joint < 3; ++joint)
    if (peak_joint_torque_Nmm_[joint] > 0.0)
      share = glm::min(share, shareWithin(peak_joint_torque_Nmm_[joint], joints_Nmm[joint]));
  force_N *= share;
  torque_Nmm *= shareWithin(peak_torque_Nmm_, length_Nmm);
  return {{{force_N}, {torque_Nmm}}, true};
}

}  // namespace haptics
