#include "haptics/device/simulated/scripted_device.h"

namespace haptics {

ScriptedDevice::ScriptedDevice(const assets::PlannedCut& cut, const CuttingMotion& motion) : path_(cut, motion) {
  hand_.position_mm = path_.at(0.0).position_mm;
  capabilities_.model = "scripted hand";
  capabilities_.damping_Ns_per_mm = hand_.totalDamping_Ns_per_mm();
}

HandleState ScriptedDevice::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  const HandTarget from = path_.at(t_s_), to = path_.at(t_s_ + dt_s);
  t_s_ += dt_s;
  return hand_.follow(from, to, wrench_D, dt_s);
}

}  // namespace haptics
