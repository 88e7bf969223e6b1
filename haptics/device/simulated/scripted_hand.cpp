#include "haptics/device/simulated/scripted_hand.h"

namespace haptics {

ScriptedHand::ScriptedHand(const assets::PlannedCut& cut, const CuttingManner& manner) : path_(cut, manner) {
  hand_.place_mm = path_.at(0.0).place_mm;
  capabilities_.model = "scripted hand";
  capabilities_.damping_Ns_per_mm = hand_.dampingInAll_Ns_per_mm();
}

HandleState ScriptedHand::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  const HandTarget from = path_.at(t_s_), to = path_.at(t_s_ + dt_s);
  hand_.advance(from.place_mm, dt_s > 0.0 ? (to.place_mm - from.place_mm) / dt_s : glm::dvec3(0.0),
                wrench_D.force_N.xyz, dt_s);
  t_s_ += dt_s;
  HandleState state;
  state.X_DH = {to.rotation, hand_.place_mm};
  state.velocity_D_mm_per_s.xyz = hand_.velocity_mm_per_s;
  state.pedal = to.pedal;
  return state;
}

}  // namespace haptics
