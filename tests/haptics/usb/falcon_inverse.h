// Inverse kinematics of the Falcon in closed form, with dimensions of its own: what the simulated unit's legs do, and
// the twin of the product's forward kinematics. mm, rad.
#pragma once

#include <cmath>
#include <optional>

#include "calibration/geometry/units.h"
#include "haptics/device/usb/falcon_kinematics.h"

namespace haptics {

/// None where a leg does not reach.
inline std::optional<FalconLegs> falconLegsAt_rad(const calibration::Point<calibration::Device>& grip_D) {
  constexpr double kThigh_mm = 60.0, kShin_mm = 102.5, kLinks_mm = 22.5;
  FalconLegs legs_rad;
  for (int leg = 0; leg < 3; ++leg) {
    const double turn = calibration::radFromDegrees(105.0 - 120.0 * leg);
    const glm::dvec3 u(std::cos(turn), std::sin(turn), 0.0), v(-u.y, u.x, 0.0);
    const double x = glm::dot(u, grip_D.mm) - 40.0 + 14.43, z = grip_D.mm.z,
                 side = glm::dot(v, grip_D.mm) + 23.09 - 25.0;
    if (!(std::abs(side) < kShin_mm)) return {};
    // The law of cosines at the base; of the two solutions the outer knee.
    const double far = std::hypot(x, z), reach = kLinks_mm + std::sqrt(kShin_mm * kShin_mm - side * side);
    const double cosine = (far * far + kThigh_mm * kThigh_mm - reach * reach) / (2.0 * kThigh_mm * far);
    if (!(std::abs(cosine) <= 1.0)) return {};
    legs_rad[leg] = std::atan2(z, x) - std::acos(cosine);
  }
  return legs_rad;
}

}  // namespace haptics
