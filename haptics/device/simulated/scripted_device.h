// A scripted surgeon's hand: a path pulls a virtual hand, and the contact force pushes that hand back. A pure function
// of its steps: no clock, no randomness. Frame D, mm, s. Without an arm's mechanics (simulated_phantom has them).
#pragma once

#include "haptics/device/simulated/trough_path.h"
#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"

namespace haptics {

class ScriptedDevice final : public SimulatedDevice {
 public:
  /// Frame D is the patient's P. Throws DeviceError when the cut is not usable.
  explicit ScriptedDevice(const assets::PlannedCut& cut, const CuttingMotion& motion = {});
  ~ScriptedDevice() override { stop(); }

  double duration_s() const { return path_.duration_s(); }

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  TroughPath path_;
  VirtualHand hand_;
  double t_s_ = 0.0;
};

}  // namespace haptics
