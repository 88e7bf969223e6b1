// The share of the force that is let through (reference/devices 6.2, 6.3): from 0 to 1 in half a second once the hand
// is active, no faster than 5 N/s at the peak, and down to 0 in 50 ms while the deadman feels no hand. Where nobody can
// be pushed all of it at once. Before the books of energy: a share that rises while the hand presses feeds it energy.
// A state of one number; servo thread, flops.
#pragma once

#include <algorithm>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class SoftStart {
 public:
  double follow(bool active, bool letting_go, const SafetyLimits& limits, double dt_s) noexcept {
    const SafetyThresholds& t = limits.thresholds;
    if (!active)
      share_ = 0.0;
    else if (letting_go)
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
