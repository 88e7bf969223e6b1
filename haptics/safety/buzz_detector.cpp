#include "haptics/safety/buzz_detector.h"

#include <algorithm>

namespace haptics {

bool BuzzDetector::buzzes(const glm::dvec3& velocity_mm_per_s, double least_mm_per_s) noexcept {
  if (!(glm::length(velocity_mm_per_s) > least_mm_per_s)) return false;
  const bool turned = glm::dot(velocity_mm_per_s, last_fast_) < 0.0;
  last_fast_ = velocity_mm_per_s;
  if (!turned) return false;
  turned_at_s_[next_] = now_s_;
  next_ = (next_ + 1) % kTurns;
  turns_ = std::min(turns_ + 1, kTurns);
  // The next one to be overwritten is the oldest.
  return turns_ == kTurns && now_s_ - turned_at_s_[next_] <= kWindow_s;
}

BuzzDetector::Output BuzzDetector::follow(const glm::dvec3& velocity_mm_per_s, const SafetyThresholds& thresholds,
                                          double dt_s) noexcept {
  now_s_ += dt_s;
  calm_s_ += dt_s;
  if (buzzes(velocity_mm_per_s, thresholds.buzz_mm_per_s)) {
    steps_ = std::min(steps_ + 1, 2);
    turns_ = 0;
    calm_s_ = 0.0;
  } else if (calm_s_ > kCalm_s && steps_ > 0) {
    --steps_;
    calm_s_ = 0.0;
  }
  const double most = steps_ == 0 ? 1.0 : steps_ == 1 ? 0.5 : 0.0;
  share_ = std::min(share_ + dt_s / kCalm_s, most);
  return {share_, steps_ == 2};
}

}  // namespace haptics
