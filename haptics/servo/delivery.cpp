#include "haptics/servo/delivery.h"

#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

/// The small rotation from one attitude to the other, in P, exact to third order.
glm::dvec3 rotationBetween_rad(const glm::dquat& from, const glm::dquat& to) {
  const glm::dquat between = to * glm::conjugate(from);
  const glm::dvec3 half(between.x, between.y, between.z);
  const double sine = glm::length(half);
  const double scale = sine > 1e-6 ? std::asin(sine < 1.0 ? sine : 1.0) / sine : 1.0;
  return (between.w < 0.0 ? -2.0 : 2.0) * scale * half;
}

}  // namespace

PassivityController::Motion Delivery::motionTo(const HandSample& hand, bool with_rotation, double dt_s) const noexcept {
  constexpr double kMaxSpeed_mm_per_s = 10'000.0;  // beyond it a relocation
  PassivityController::Motion motion;
  motion.travel_P_mm.xyz =
      (hand.X_PT.translation_mm - last_hand_.X_PT.translation_mm) + (hand.arm_P_mm.xyz - last_hand_.arm_P_mm.xyz);
  if (glm::length(motion.travel_P_mm.xyz) > kMaxSpeed_mm_per_s * dt_s) return {};
  if (with_rotation) motion.rotation_P_rad.xyz = rotationBetween_rad(last_hand_.X_PT.rotation, hand.X_PT.rotation);
  return motion;
}

SafetyFilter::Delivered Delivery::deliver(const SafetyLayer::Request& law, Changes changes, const HandSample& hand,
                                          SafetyLayer& safety, const SafetyLimits& limits, double dt_s) noexcept {
  const bool with_torque = limits.peak_torque_Nmm > 0.0;
  SafetyLayer::Request request = law;
  if (!changes.relocated) request.motion = motionTo(hand, with_torque, dt_s);
  last_hand_ = hand;

  // About the handle, where the device pushes.
  request.wrench_P.torque_Nmm.xyz -= glm::cross(hand.arm_P_mm.xyz, request.wrench_P.force_N.xyz);
  if (!with_torque) request.wrench_P.torque_Nmm = {};
  request.wrench_P = transition_.update(request.wrench_P, changes.switched || changes.relocated, dt_s);
  return safety.serve(request, limits, dt_s);
}

}  // namespace haptics
