// The share of the force that passes (reference/devices 6.2, 6.3): from 0 to 1 in half a second once the hand is
// active, at most 5 N/s at the peak, and to 0 in 50 ms while the deadman detects no hand. Without motors 1 at once.
// Before the passivity controller: a share that rises while the hand presses feeds it energy. Servo thread, flops.
#pragma once

#include <algorithm>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class SoftStart {
 public:
  double update(bool active, bool releasing, const SafetyLimits& limits, double dt_s) noexcept {
    const SafetyThresholds& t = limits.thresholds;
    if (!active)
      share_ = 0.0;
    else if (releasing)
      share_ = std::max(0.0, share_ - dt_s / t.release_s);
    else if (!limits.must_be_armed)
      share_ = 1.0;
    else
      share_ = std::min(1.0, share_ + dt_s / std::max(t.soft_start_s, limits.peak_force_N / t.soft_start_N_per_s));
    return share_;
  }

 private:
  double share_ = 0.0;
};

}  // namespace haptics
