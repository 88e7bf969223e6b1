#include "haptics/servo/delivery.h"

#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

/// The small rotation from one attitude to the other, in P, exact to its third power.
glm::dvec3 turnBetween_rad(const glm::dquat& from, const glm::dquat& to) {
  const glm::dquat turn = to * glm::conjugate(from);
  const glm::dvec3 half(turn.x, turn.y, turn.z);
  const double sine = glm::length(half);
  const double scale = sine > 1e-6 ? std::asin(sine < 1.0 ? sine : 1.0) / sine : 1.0;
  return (turn.w < 0.0 ? -2.0 : 2.0) * scale * half;
}

}  // namespace

PassivityController::Motion Delivery::motionTo(const HandSample& hand, bool with_turn, double dt_s) const noexcept {
  constexpr double kFastest_mm_per_s = 10'000.0;  // no hand is faster: it was put there
  PassivityController::Motion motion;
  motion.travel_P_mm.xyz =
      (hand.X_PT.translation_mm - last_hand_.X_PT.translation_mm) + (hand.arm_P_mm.xyz - last_hand_.arm_P_mm.xyz);
  if (glm::length(motion.travel_P_mm.xyz) > kFastest_mm_per_s * dt_s) return {};
  if (with_turn) motion.turn_P_rad.xyz = turnBetween_rad(last_hand_.X_PT.rotation, hand.X_PT.rotation);
  return motion;
}

SafetyFilter::Delivered Delivery::deliver(const Request& wanted, const HandSample& hand, SafetyLayer& safety,
                                          const SafetyLimits& limits, double dt_s) noexcept {
  const bool with_torque = limits.peak_torque_Nmm > 0.0;
  SafetyLayer::Request wish;
  if (!wanted.relocated) wish.motion = motionTo(hand, with_torque, dt_s);
  last_hand_ = hand;

  // About the handle, where the device pushes.
  Wrench<Patient> wrench = wanted.wrench_P;
  wrench.torque_Nmm.xyz -= glm::cross(hand.arm_P_mm.xyz, wrench.force_N.xyz);
  if (!with_torque) wrench.torque_Nmm = {};

  wish.wrench_P = transition_.follow(wrench, wanted.switched || wanted.relocated, dt_s);
  wish.vibration_P_N = wanted.vibration_P_N;
  wish.max_stored_Nmm = wanted.max_stored_Nmm;
  wish.touches = wanted.touches;
  return safety.serve(wish, limits, dt_s);
}

}  // namespace haptics
