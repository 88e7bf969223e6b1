#include "haptics/servo/hand_guard.h"

#include <cmath>

namespace haptics {
namespace {

constexpr double kFarthest_mm = 10'000.0, kLongestJump_mm = 1'000.0, kSamePlace_mm = 20.0;
constexpr int kSamplesToBelieve = 100;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Finite, near, and with a rotation that can be made unit.
bool usable(const HandSample& hand) {
  const double norm = glm::dot(hand.X_PT.rotation, hand.X_PT.rotation);
  const glm::dvec3& p = hand.X_PT.translation_mm;
  return finite(p) && finite(hand.velocity_P_mm_per_s.xyz) && glm::length(p) <= kFarthest_mm && std::isfinite(norm) &&
         norm > 0.25 && norm < 4.0;
}

}  // namespace

HandGuard::Checked HandGuard::check(const HandSample& hand) noexcept {
  Checked checked;
  bool accept = usable(hand);
  checked.relocated = !started_;
  if (accept && started_) {
    const glm::dvec3& p = hand.X_PT.translation_mm;
    if (glm::length(p - good_.X_PT.translation_mm) > kLongestJump_mm) {
      far_count_ = far_count_ > 0 && glm::length(p - far_mm_) < kSamePlace_mm ? far_count_ + 1 : 1;
      far_mm_ = p;
      accept = checked.relocated = far_count_ >= kSamplesToBelieve;
    }
  }
  if (accept) {
    started_ = true;
    far_count_ = 0;
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
