// Limits a force to what the joints can bear: tau = J^T F of the motor-driven joints, each within its peak; the whole
// force is scaled, so its direction stays (reference/devices 4.3, 6.7: 3.3 N upwards are 424 N mm at a Touch's thigh,
// 350 are allowed). Force and Jacobian in one frame. Any thread; a dozen flops.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace haptics {

/// 0 to 1. A peak of 0 is no limit; an unknown Jacobian is zero and does not limit.
inline double shareForJoints(const glm::dmat3& jacobian_mm, const glm::dvec3& force_N,
                             const glm::dvec3& peak_Nmm) noexcept {
  double share = 1.0;
  for (int joint = 0; joint < 3; ++joint) {
    const double torque_Nmm = std::abs(glm::dot(jacobian_mm[joint], force_N));
    if (peak_Nmm[joint] > 0.0 && torque_Nmm > peak_Nmm[joint]) share = std::min(share, peak_Nmm[joint] / torque_Nmm);
  }
  return share;
}

}  // namespace haptics
