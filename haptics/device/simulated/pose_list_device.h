// Plays a list of timed poses, whatever force is applied: linear and slerp between two of them, still before the first
// and after the last, the pedal up after the last. One pose holds still. Tick n is at n/rate. Frame D, mm, s. No
// allocation after construction.
#pragma once

#include <vector>

#include "haptics/device/simulated_device.h"

namespace haptics {

struct TimedHandlePose {
  double t_s = 0.0;
  calibration::Pose<calibration::Device, calibration::Handle> X_DH;
  bool pedal = false;         ///< until the next pose
  std::uint32_t buttons = 0;  ///< alike
};

class PoseListDevice final : public SimulatedDevice {
 public:
  /// Throws DeviceError when there is no pose, one is not finite and rigid, or the times do not rise from 0 or later.
  explicit PoseListDevice(std::vector<TimedHandlePose> poses);
  ~PoseListDevice() override { stop(); }

  /// The time of the last pose.
  double duration_s() const { return poses_.back().t_s; }

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  HandleState stateAt(double t_s) noexcept;

  std::vector<TimedHandlePose> poses_;
  std::size_t next_ = 0;  ///< the first pose not yet reached
  std::uint64_t ticks_ = 0;
  glm::dvec3 last_mm_{0.0};
};

}  // namespace haptics
