// Plays recorded handle states at their recorded rate, whatever force is applied, then holds the last with the pedal
// up. Frame D, mm. No allocation after construction. It moves the hand of a new session; `molar replay` recomputes an
// old one.
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

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  std::vector<HandleState> states_;
  double dt_s_;
  std::size_t next_ = 0;
};

}  // namespace haptics
