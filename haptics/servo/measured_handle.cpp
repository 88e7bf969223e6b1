#include "haptics/servo/measured_handle.h"

#include <cmath>

namespace haptics {
namespace {

bool isFinite(const calibration::Pose<calibration::Device, calibration::Handle>& X) {
  return std::isfinite(glm::dot(X.rotation, X.rotation)) && std::isfinite(glm::length(X.translation_mm));
}

}  // namespace

MeasuredHandle::MeasuredHandle(const std::optional<calibration::MeasuredArm>& arm) : arm_(arm) {
  if (arm && !isFinite(arm->X_DH({0.1, 0.2, 0.3, 0.4, 0.5, 0.6})))
    throw DeviceError("correction of the arm, not finite, calibrate the rig again");
}

HandleState MeasuredHandle::corrected(HandleState state) noexcept {
  if (!arm_) return state;
  if (state.has_joints) {
    const auto X_DH = arm_->X_DH(state.joints_rad);
    if (isFinite(X_DH)) {
      state.X_DH = X_DH;
      last_DH_ = X_DH;
      return state;
    }
  }
  if (!last_DH_) return state;
  state.X_DH = *last_DH_;
  state.fresh = false;
  return state;
}

}  // namespace haptics
