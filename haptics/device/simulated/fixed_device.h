// A hand by script that holds one place, whatever force it is given: an assistant's, with mirror or retractor. Frame D,
// mm. No allocation after construction.
#pragma once

#include "haptics/device/simulated_device.h"

namespace haptics {

class FixedDevice final : public SimulatedDevice {
 public:
  /// Throws DeviceError when the pose is not finite and rigid.
  explicit FixedDevice(const calibration::Pose<calibration::Device, calibration::Handle>& X_DH);
  ~FixedDevice() override { stop(); }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  HandleState state_;
  DeviceCapabilities capabilities_;
};

}  // namespace haptics
