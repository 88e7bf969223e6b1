// A surgeon's hand by script: its path pulls a virtual hand, so the bone's force really pushes it back. A pure function
// of the steps it is given: no clock, no randomness. Frame D, mm, s. Not a machine (simulated_phantom).
#pragma once

#include "haptics/device/simulated/trough_path.h"
#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"

namespace haptics {

class ScriptedDevice final : public SimulatedDevice {
 public:
  /// Its frame D is the patient's P. Throws DeviceError when the cut is not usable.
  explicit ScriptedDevice(const assets::PlannedCut& cut, const CuttingMotion& manner = {});
  ~ScriptedDevice() override { stop(); }

  double duration_s() const { return path_.duration_s(); }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  TroughPath path_;
  VirtualHand hand_;
  double t_s_ = 0.0;
  DeviceCapabilities capabilities_;
};

}  // namespace haptics
