// A hand that was recorded, moving again: state by state, whatever force it is given, then still with the pedal up
// where it ended. The states are what a device said, at the rate they were recorded at. Frame D, mm. No allocation
// after construction. What a session came to is not asked of it: that is `molar replay`.
#pragma once

#include <vector>

#include "haptics/device/simulated_device.h"

namespace haptics {

class ReplayDevice final : public SimulatedDevice {
 public:
  /// Throws DeviceError when there is no state or the period is not one of 500..10000 Hz.
  ReplayDevice(std::vector<HandleState> states, double dt_s);
  ~ReplayDevice() override { stop(); }

  double rate_Hz() const { return 1.0 / dt_s_; }
  double duration_s() const { return static_cast<double>(states_.size()) * dt_s_; }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  std::vector<HandleState> states_;
  double dt_s_;
  std::size_t next_ = 0;
  DeviceCapabilities capabilities_;
};

}  // namespace haptics
