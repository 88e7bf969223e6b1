// Detects an oscillating contact (reference/devices 6.6): more than 20 velocity reversals in 0.1 s, each at more than
// 20 mm/s, are a limit cycle, not a hand. The force is halved, and if it goes on, switched off with a fault. After a
// second of calm it returns by one step, over a second. Any frame. Constant work per call; servo thread.
#pragma once

#include <array>
#include <cstddef>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class BuzzDetector {
 public:
  static constexpr std::size_t kReversals = 21;
  static constexpr double kWindow_s = 0.1, kCalm_s = 1.0;

  struct Output {
    double share = 1.0;  ///< of the force
    bool off = false;    ///< halving did not help
  };
  Output update(const glm::dvec3& velocity_mm_per_s, const SafetyThresholds& thresholds, double dt_s) noexcept;

 private:
  bool buzzes(const glm::dvec3& velocity_mm_per_s, double min_mm_per_s) noexcept;

  std::array<double, kReversals> reversal_at_s_{};
  std::size_t reversals_ = 0, next_ = 0;
  glm::dvec3 last_fast_{0.0};
  double now_s_ = 0.0, calm_s_ = 0.0, share_ = 1.0;
  int steps_ = 0;  ///< 0 full force, 1 half, 2 none
};

}  // namespace haptics
