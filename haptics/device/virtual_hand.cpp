#include "haptics/device/virtual_hand.h"

#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {

void VirtualHand::advance(const glm::dvec3& target_mm, const glm::dvec3& target_velocity_mm_per_s,
                          const glm::dvec3& force_N, double dt_s) {
  if (!std::isfinite(glm::length(force_N)) || !std::isfinite(glm::length(target_mm)) ||
      !std::isfinite(glm::length(target_velocity_mm_per_s)))
    return;
  // Stiffness in N/m over mass in kg: critically damped about where target and force balance.
  const double rate = std::sqrt(stiffness_N_per_mm * 1000.0 / mass_kg);
  const glm::dvec3 rest_mm = target_mm + force_N / stiffness_N_per_mm;
  const double decay = std::exp(-rate * dt_s);
  const glm::dvec3 away = place_mm - rest_mm, drift = velocity_mm_per_s - target_velocity_mm_per_s;
  const glm::dvec3 slope = drift + rate * away;
  place_mm = rest_mm + target_velocity_mm_per_s * dt_s + (away + slope * dt_s) * decay;
  velocity_mm_per_s = target_velocity_mm_per_s + (drift - rate * dt_s * slope) * decay;
}

}  // namespace haptics
