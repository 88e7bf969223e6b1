#include "haptics/device/simulated/pose_list_device.h"

#include <cmath>
#include <utility>

namespace haptics {

PoseListDevice::PoseListDevice(std::vector<TimedHandlePose> poses) : poses_(std::move(poses)) {
  if (poses_.empty()) throw DeviceError("posed hand: it has no poses, give some");
  double last_s = -1.0;
  for (const TimedHandlePose& pose : poses_) {
    const double norm = glm::dot(pose.X_DH.rotation, pose.X_DH.rotation);
    if (!(std::abs(norm - 1.0) < 1e-6) || !std::isfinite(glm::length(pose.X_DH.translation_mm)))
      throw DeviceError("posed hand: a pose is not finite and rigid, correct it");
    if (!(pose.t_s >= 0.0 && pose.t_s > last_s) || !std::isfinite(pose.t_s))
      throw DeviceError("posed hand: its times do not rise from 0 or later, order them");
    last_s = pose.t_s;
  }
  last_mm_ = poses_.front().X_DH.translation_mm;
  capabilities_.model = "posed hand";
}

HandleState PoseListDevice::stateAt(double t_s) noexcept {
  while (next_ < poses_.size() && poses_[next_].t_s <= t_s) ++next_;
  HandleState state;
  const TimedHandlePose& from = poses_[next_ == 0 ? 0 : next_ - 1];
  state.X_DH = from.X_DH;
  if (next_ == 0 || next_ == poses_.size()) return state;
  const TimedHandlePose& to = poses_[next_];
  const double part = (t_s - from.t_s) / (to.t_s - from.t_s);
  // Between two equal poses it is still to the last bit.
  if (to.X_DH.rotation != from.X_DH.rotation)
    state.X_DH.rotation = glm::slerp(from.X_DH.rotation, to.X_DH.rotation, part);
  if (to.X_DH.translation_mm != from.X_DH.translation_mm)
    state.X_DH.translation_mm = glm::mix(from.X_DH.translation_mm, to.X_DH.translation_mm, part);
  state.pedal = from.pedal;
  state.buttons = from.buttons;
  return state;
}

HandleState PoseListDevice::exchange(const Wrench<calibration::Device>&, double dt_s) noexcept {
  // Divided, not summed: a tick at the time of a pose is exactly there.
  const double t_s = dt_s > 0.0 ? static_cast<double>(ticks_++) / (1.0 / dt_s) : 0.0;
  HandleState state = stateAt(t_s);
  if (dt_s > 0.0) state.velocity_D_mm_per_s.xyz = (state.X_DH.translation_mm - last_mm_) / dt_s;
  last_mm_ = state.X_DH.translation_mm;
  return state;
}

}  // namespace haptics
