#include "haptics/device/simulated/fixed_device.h"

#include <cmath>

namespace haptics {

FixedDevice::FixedDevice(const calibration::Pose<calibration::Device, calibration::Handle>& X_DH) {
  const double norm = glm::dot(X_DH.rotation, X_DH.rotation);
  if (!(std::abs(norm - 1.0) < 1e-6) || !std::isfinite(glm::length(X_DH.translation_mm)))
    throw DeviceError("scripted still hand, its place is not finite and rigid, give another");
  state_.X_DH = X_DH;
  capabilities_.model = "scripted still hand";
}

HandleState FixedDevice::exchange(const Wrench<calibration::Device>&, double) noexcept { return state_; }

}  // namespace haptics
