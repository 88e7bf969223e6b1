// Hears a contact that shakes (reference/devices 6.6): more than 20 turns of the velocity in 0.1 s, each at more than
// 20 mm/s, are no hand but a limit cycle. The force is halved, and when it goes on, off: a fault. After a second of
// calm it comes back by one step, over a second. Any frame, for a turn is a velocity against the one before. Work per
// call is constant; servo thread.
#pragma once

#include <array>
#include <cstddef>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class BuzzDetector {
 public:
  static constexpr std::size_t kTurns = 21;
  static constexpr double kWindow_s = 0.1, kCalm_s = 1.0;

  struct Output {
    double share = 1.0;  ///< of the force
    bool off = false;    ///< halving it did not help
  };
  Output follow(const glm::dvec3& velocity_mm_per_s, const SafetyThresholds& thresholds, double dt_s) noexcept;

 private:
  bool buzzes(const glm::dvec3& velocity_mm_per_s, double least_mm_per_s) noexcept;

  std::array<double, kTurns> turned_at_s_{};
  std::size_t turns_ = 0, next_ = 0;
  glm::dvec3 last_fast_{0.0};
  double now_s_ = 0.0, calm_s_ = 0.0, share_ = 1.0;
  int steps_ = 0;  ///< 0 all of it, 1 half, 2 none
};

}  // namespace haptics
