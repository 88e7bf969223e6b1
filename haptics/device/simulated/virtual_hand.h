// Mechanical model of a hand for the simulated devices: a mass, with viscous friction of the device it holds, pulled to
// a target by a spring and damper, displaced by force. Frame D, mm, N, s. Integrated in closed form over a step of
// constant force and steadily moving target: exact and stable for every dt, like a device that holds its force between
// two ticks. Defaults: 0.1 kg and 0.5 N/mm, critically damped, no friction: a light grip on a stylus (starting values;
// reference/physics 2.5 uses 0.1 kg). One thread; no allocation.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "haptics/device/haptic_device.h"
#include "haptics/device/simulated/hand_script.h"

namespace haptics {

/// 2 sqrt(k m): fastest return without overshoot.
inline double criticalDamping_Ns_per_mm(double mass_kg, double stiffness_N_per_mm) {
  return 2.0 * std::sqrt(stiffness_N_per_mm * mass_kg * 1e-3);
}

struct VirtualHand {
  double mass_kg = 0.1;
  double stiffness_N_per_mm = 0.5;
  double damping_Ns_per_mm = criticalDamping_Ns_per_mm(0.1, 0.5);  ///< of the grip
  double friction_Ns_per_mm = 0.0;                                 ///< of the device, against the ground
  glm::dvec3 position_mm{0.0};
  glm::dvec3 velocity_mm_per_s{0.0};

  double totalDamping_Ns_per_mm() const { return damping_Ns_per_mm + friction_Ns_per_mm; }

  /// Advances from one target of a script to the next under the device's wrench; what the device then measures.
  HandleState follow(const HandTarget& from, const HandTarget& to, const Wrench<calibration::Device>& wrench_D,
                     double dt_s);
  /// Advances by `dt_s` towards a target that moves at `target_velocity`, under `force_N`.
  void advance(const glm::dvec3& target_mm, const glm::dvec3& target_velocity_mm_per_s, const glm::dvec3& force_N,
               double dt_s);
};

}  // namespace haptics
