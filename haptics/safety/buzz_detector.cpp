#include "haptics/safety/buzz_detector.h"

#include <algorithm>

namespace haptics {

bool BuzzDetector::buzzes(const glm::dvec3& velocity_mm_per_s, double min_mm_per_s) noexcept {
  if (!(glm::length(velocity_mm_per_s) > min_mm_per_s)) return false;
  const bool reversed = glm::dot(velocity_mm_per_s, last_fast_) < 0.0;
  last_fast_ = velocity_mm_per_s;
  if (!reversed) return false;
  reversal_at_s_[next_] = now_s_;
  next_ = (next_ + 1) % kReversals;
  reversals_ = std::min(reversals_ + 1, kReversals);
  // The next to be overwritten is the oldest.
  return reversals_ == kReversals && now_s_ - reversal_at_s_[next_] <= kWindow_s;
}

BuzzDetector::Output BuzzDetector::update(const glm::dvec3& velocity_mm_per_s, const SafetyThresholds& thresholds,
                                          double dt_s) noexcept {
  now_s_ += dt_s;
  calm_s_ += dt_s;
  if (buzzes(velocity_mm_per_s, thresholds.buzz_mm_per_s)) {
    steps_ = std::min(steps_ + 1, 2);
    reversals_ = 0;
    calm_s_ = 0.0;
  } else if (calm_s_ > kCalm_s && steps_ > 0) {
    --steps_;
    calm_s_ = 0.0;
  }
  const double target = steps_ == 0 ? 1.0 : steps_ == 1 ? 0.5 : 0.0;
  share_ = std::min(share_ + dt_s / kCalm_s, target);
  return {share_, steps_ == 2};
}

}  // namespace haptics
