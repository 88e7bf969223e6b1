// A surgeon's hand by script: its path pulls a virtual hand, so the bone's force really pushes it back. A pure function
// of the steps it is given: no clock, no randomness. Frame D, mm, s. Not a machine (device/simulated_device).
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/device/trough_path.h"
#include "haptics/device/virtual_hand.h"

namespace haptics {

class ScriptedHand final : public HapticDevice {
 public:
  /// Throws DeviceError when the plan is not usable.
  explicit ScriptedHand(const TroughPlan& plan);

  double duration_s() const { return path_.duration_s(); }

  DeviceCapabilities capabilities() const override;
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  TroughPath path_;
  VirtualHand hand_;
  double t_s_ = 0.0;
};

}  // namespace haptics
