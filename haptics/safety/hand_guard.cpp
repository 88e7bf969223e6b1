#include "haptics/safety/hand_guard.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/pose.h"

namespace haptics {
namespace {

using calibration::isFinite;

/// Limit of a plausible position; limit of a move that is no relocation.
constexpr double kFarthest_mm = 10'000.0, kLongestMove_mm = 1'000.0;

glm::dvec3 handle_mm(const HandSample& hand) { return hand.X_PT.translation_mm + hand.arm_P_mm.xyz; }

/// Finite, near, and with a rotation that can be normalised.
bool usable(const HandSample& hand) {
  const double norm = glm::dot(hand.X_PT.rotation, hand.X_PT.rotation);
  const glm::dvec3& p = hand.X_PT.translation_mm;
  const glm::dmat3& J = hand.jacobian_P_mm;
  return isFinite(p) && isFinite(hand.velocity_P_mm_per_s.xyz) && isFinite(hand.handle_velocity_P_mm_per_s.xyz) &&
         glm::length(hand.arm_P_mm.xyz) <= kFarthest_mm && glm::length(p) <= kFarthest_mm && std::isfinite(norm) &&
         norm > 0.25 && norm < 4.0 && isFinite(J[0]) && isFinite(J[1]) && isFinite(J[2]);
}

HandSample withUnitRotation(const HandSample& hand) {
  HandSample unit = hand;
  unit.X_PT.rotation = glm::normalize(hand.X_PT.rotation);
  return unit;
}

/// `now` at the pose of `good`.
HandSample heldAt(const HandSample& good, const HandSample& now) {
  HandSample hand = now;
  hand.X_PT = good.X_PT;
  hand.velocity_P_mm_per_s = good.velocity_P_mm_per_s;
  hand.arm_P_mm = good.arm_P_mm;
  hand.handle_velocity_P_mm_per_s = good.handle_velocity_P_mm_per_s;
  hand.jacobian_P_mm = good.jacobian_P_mm;
  return hand;
}

}  // namespace

/// Within a hand's speed since the last valid sample.
bool HandGuard::moved(const HandSample& hand, const SafetyLimits& limits) const noexcept {
  if (glm::length(handle_mm(hand) - handle_mm(good_)) > limits.max_speed_mm_per_s * since_good_s_) return false;
  const double half_turn_rad = 0.5 * limits.max_angular_speed_rad_per_s * since_good_s_;
  if (half_turn_rad >= 1.57) return true;
  return std::abs(glm::dot(glm::normalize(hand.X_PT.rotation), good_.X_PT.rotation)) >= std::cos(half_turn_rad);
}

HandGuard::Checked HandGuard::check(const HandSample& hand, const SafetyLimits& limits, double dt_s) noexcept {
  const double elapsed_s = std::isfinite(hand.gap_s) ? std::max(dt_s, hand.gap_s) : dt_s;
  since_good_s_ += elapsed_s;
  Checked checked;
  checked.resumed = elapsed_s > limits.thresholds.max_pause_s;
  const bool restarts = limits.must_be_armed && (checked.resumed || bad_ >= kMaxBadInARow);

  if (!hand.fresh) {
    checked.refused = !started_;
    checked.hand = heldAt(good_, hand);
  } else if (usable(hand) && (!started_ || (limits.must_be_armed && checked.resumed) || moved(hand, limits))) {
    checked.relocated = !started_ || restarts || glm::length(handle_mm(hand) - handle_mm(good_)) > kLongestMove_mm;
    good_ = withUnitRotation(hand);
    started_ = true;
    since_good_s_ = 0.0;
    bad_ = 0;
    checked.hand = good_;
    return checked;
  } else {
    bad_ = std::min(bad_ + 1, kMaxBadInARow);
    checked.refused = true;
    checked.hand = heldAt(good_, hand);
  }
  if (bad_ > 0 || !started_) {
    checked.hand.velocity_P_mm_per_s = {};
    checked.hand.handle_velocity_P_mm_per_s = {};
    checked.hand.drill_pedal = false;
  }
  checked.lost = bad_ >= kMaxBadInARow;
  checked.confidence = checked.lost || !started_ ? 0.0 : std::ldexp(1.0, -bad_);
  return checked;
}

}  // namespace haptics
