// A hand that is exactly where a list of poses has it, whatever force it is given: between two of them on the straight
// line and turning evenly, before the first and after the last still there, the pedal up after the last. Tick n is at
// n/rate. Frame D, mm, s. No grip, no tremor. The device's thread; no allocation after construction.
#pragma once

#include <vector>

#include "haptics/device/simulated_device.h"

namespace haptics {

struct TimedHandlePose {
  double t_s = 0.0;
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  bool pedal = false;  ///< from here to the next
};

class PoseListDevice final : public SimulatedDevice {
 public:
  /// Throws DeviceError when there is no pose, one is not finite and rigid, or the times do not rise from 0 or later.
  explicit PoseListDevice(std::vector<TimedHandlePose> holds);
  ~PoseListDevice() override { stop(); }

  /// When the last one is reached.
  double duration_s() const { return holds_.back().t_s; }

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  HandleState stateAt(double t_s) noexcept;

  std::vector<TimedHandlePose> holds_;
  std::size_t next_ = 0;  ///< the first that lies ahead
  std::uint64_t ticks_ = 0;
  glm::dvec3 last_mm_{0.0};
  DeviceCapabilities capabilities_;
};

}  // namespace haptics
