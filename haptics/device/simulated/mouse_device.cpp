#include "haptics/device/simulated/mouse_device.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

bool isUsable(const MouseTarget& target) {
  const double norm = glm::dot(target.X_DH.rotation, target.X_DH.rotation);
  return std::isfinite(glm::length(target.X_DH.translation_mm)) && norm > 0.25 && norm < 4.0;
}

}  // namespace

MouseDevice::MouseDevice(const MouseTarget& start) : target_(start), rotation_(start.X_DH.rotation) {
  hand_.position_mm = start.X_DH.translation_mm;
  capabilities_.model = "mouse";
  capabilities_.damping_Ns_per_mm = hand_.totalDamping_Ns_per_mm();
}

void MouseDevice::placeAt(const MouseTarget& target) {
  if (!isUsable(target)) return;
  hand_.position_mm = target.X_DH.translation_mm;
  rotation_ = glm::normalize(target.X_DH.rotation);
  target_.publish(target);
}

void MouseDevice::setTarget(const MouseTarget& target) {
  if (isUsable(target)) target_.publish(target);
}

HandleState MouseDevice::exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept {
  const MouseTarget& target = target_.read();
  hand_.advance(target.X_DH.translation_mm, glm::dvec3(0.0), wrench_D.force_N.xyz, dt_s);
  // Turns with the time constant of the hand.
  rotation_ = glm::slerp(rotation_, glm::normalize(target.X_DH.rotation), 1.0 - std::exp(-30.0 * dt_s));
  HandleState state;
  state.X_DH = {glm::normalize(rotation_), hand_.position_mm};
  state.velocity_D_mm_per_s.xyz = hand_.velocity_mm_per_s;
  state.pedal = target.pedal;
  return state;
}

}  // namespace haptics
