#include "haptics/safety/hand_guard.h"

#include <cmath>

namespace haptics {
namespace {

constexpr double kFarthest_mm = 10'000.0, kLongestJump_mm = 1'000.0, kSamePlace_mm = 20.0;
constexpr double kTimeToBelieve_s = 0.1;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Finite, near, and with a rotation that can be made unit.
bool usable(const HandSample& hand) {
  const double norm = glm::dot(hand.X_PT.rotation, hand.X_PT.rotation);
  const glm::dvec3& p = hand.X_PT.translation_mm;
  return finite(p) && finite(hand.velocity_P_mm_per_s.xyz) && glm::length(hand.arm_P_mm.xyz) <= kFarthest_mm &&
         glm::length(p) <= kFarthest_mm && std::isfinite(norm) && norm > 0.25 && norm < 4.0;
}

}  // namespace

HandGuard::Checked HandGuard::check(const HandSample& hand, double dt_s) noexcept {
  Checked checked;
  bool accept = usable(hand);
  checked.relocated = !started_;
  if (accept && started_) {
    const glm::dvec3& p = hand.X_PT.translation_mm;
    if (glm::length(p - good_.X_PT.translation_mm) > kLongestJump_mm) {
      far_s_ = far_s_ > 0.0 && glm::length(p - far_mm_) < kSamePlace_mm ? far_s_ + dt_s : dt_s;
      far_mm_ = p;
      accept = checked.relocated = far_s_ > kTimeToBelieve_s - 0.5 * dt_s;
    }
  }
  if (accept) {
    started_ = true;
    far_s_ = 0.0;
    good_ = hand;
    good_.X_PT.rotation = glm::normalize(hand.X_PT.rotation);
    checked.hand = good_;
    return checked;
  }
  checked.refused = true;
  checked.hand = good_;
  checked.hand.velocity_P_mm_per_s = {};
  checked.hand.drill_pedal = false;
  checked.hand.device_healthy = hand.device_healthy;
  return checked;
}

}  // namespace haptics
