// Brakes a hand faster than work needs and releases it at runaway speed (reference/devices 6.6): above 600 mm/s a
// damper of what the device recommends, above 1000 mm/s no force for 0.1 s.
//   F = -B (|v| - 600 mm/s) v/|v|       starts at 0; at most 2 N with 5 N s/m
// Servo thread, flops.
#pragma once

#include <algorithm>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class VelocityGuard {
 public:
  struct Output {
    glm::dvec3 brake_N{0.0};
    bool cuts = false;  ///< no force at all
  };

  Output update(const glm::dvec3& velocity_mm_per_s, const SafetyLimits& limits, double dt_s) noexcept {
    const SafetyThresholds& t = limits.thresholds;
    const double speed = glm::length(velocity_mm_per_s);
    cutoff_left_s_ = speed > t.cutoff_mm_per_s ? t.cutoff_s : std::max(0.0, cutoff_left_s_ - dt_s);
    Output verdict;
    verdict.cuts = cutoff_left_s_ > 1e-9;
    if (!verdict.cuts && speed > t.brake_mm_per_s)
      verdict.brake_N = -limits.max_damping_Ns_per_mm * (1.0 - t.brake_mm_per_s / speed) * velocity_mm_per_s;
    return verdict;
  }

 private:
  double cutoff_left_s_ = 0.0;
};

}  // namespace haptics
