#include "haptics/device/simulated/simulated_device.h"

#include <cmath>

namespace haptics {

SimulatedMachine::SimulatedMachine(const SimulatedMechanics& mechanics, const HandTarget& start)
    : mechanics_(mechanics) {
  const SimulatedMechanics& m = mechanics_;
  for (double number : {m.mass_kg, m.friction_Ns_per_mm, m.grip_N_per_mm, m.grip_Ns_per_mm, m.resolution_mm,
                        m.peak_force_N, m.peak_torque_Nmm})
    if (!(std::isfinite(number) && number >= 0.0))
      throw DeviceError("simulated device, one of its numbers is negative or not finite, give usable ones");
  if (!(m.mass_kg > 0.0)) throw DeviceError("simulated device, it has no mass, give it one");
  hand_.mass_kg = m.mass_kg;
  hand_.stiffness_N_per_mm = m.grip_N_per_mm;
  hand_.damping_Ns_per_mm = m.grip_Ns_per_mm;
  hand_.friction_Ns_per_mm = m.friction_Ns_per_mm;
  hand_.place_mm = start.place_mm;
}

DeviceCapabilities SimulatedMachine::capabilities() const {
  DeviceCapabilities known;
  known.peak_force_N = mechanics_.peak_force_N;
  known.peak_torque_Nmm = mechanics_.peak_torque_Nmm;
  known.damping_Ns_per_mm = hand_.dampingInAll_Ns_per_mm();
  return known;
}

HandleState SimulatedMachine::move(const HandTarget& from, const HandTarget& to,
                                   const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  glm::dvec3 force_N = wrench_D.force_N.xyz;
  const double asked_N = glm::length(force_N);
  if (asked_N > mechanics_.peak_force_N) force_N *= mechanics_.peak_force_N / asked_N;
  const glm::dvec3 along = dt_s > 0.0 ? (to.place_mm - from.place_mm) / dt_s : glm::dvec3(0.0);
  hand_.advance(from.place_mm, along, force_N, dt_s);

  HandleState state;
  glm::dvec3 seen_mm = hand_.place_mm;
  if (mechanics_.resolution_mm > 0.0)
    seen_mm = glm::round(seen_mm / mechanics_.resolution_mm) * mechanics_.resolution_mm;
  state.X_DH = {to.rotation, seen_mm};
  state.velocity_D_mm_per_s.xyz = hand_.velocity_mm_per_s;
  state.pedal = to.pedal;
  return state;
}

HandleState SimulatedDevice::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  const HandTarget from = path_.at(t_s_);
  t_s_ += dt_s;
  return machine_.move(from, path_.at(t_s_), wrench_D, dt_s);
}

}  // namespace haptics
