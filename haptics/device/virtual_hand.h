// A hand of flesh for the simulated devices: a mass on a critically damped spring that follows a target and gives way
// to force. Frame D, mm, N, s. Integrated in closed form over a step of constant target and force: stable for every dt.
// Defaults: m 0.1 kg and k 0.5 N/mm, a light grip on a stylus (starting values, reference/physics 2.5 uses m = 0.1 kg).
// Any one thread; no allocation.
#pragma once

#include <glm/glm.hpp>

namespace haptics {

struct VirtualHand {
  double mass_kg = 0.1;
  double stiffness_N_per_mm = 0.5;
  glm::dvec3 place_mm{0.0};
  glm::dvec3 velocity_mm_per_s{0.0};

  /// Moves by `dt_s` towards a target that itself moves at `target_velocity`, pushed by `force_N`.
  void advance(const glm::dvec3& target_mm, const glm::dvec3& target_velocity_mm_per_s, const glm::dvec3& force_N,
               double dt_s);
};

}  // namespace haptics
