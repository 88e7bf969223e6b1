#include "haptics/device/simulated/scripted_device.h"

namespace haptics {

ScriptedDevice::ScriptedDevice(const assets::PlannedCut& cut, const CuttingMotion& motion) : path_(cut, motion) {
  hand_.position_mm = path_.at(0.0).position_mm;
  capabilities_.model = "scripted hand";
  capabilities_.damping_Ns_per_mm = hand_.totalDamping_Ns_per_mm();
}

HandleState ScriptedDevice::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  const HandTarget from = path_.at(t_s_), to = path_.at(t_s_ + dt_s);
  hand_.advance(from.position_mm, dt_s > 0.0 ? (to.position_mm - from.position_mm) / dt_s : glm::dvec3(0.0),
                wrench_D.force_N.xyz, dt_s);
  t_s_ += dt_s;
  HandleState state;
  state.X_DH = {to.rotation, hand_.position_mm};
  state.velocity_D_mm_per_s.xyz = hand_.velocity_mm_per_s;
  state.pedal = to.pedal;
  return state;
}

}  // namespace haptics
