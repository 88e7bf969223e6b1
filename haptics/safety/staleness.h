// Age of the last measurement and the share of the force it still allows (reference/devices 6.9): up to 3 ms as if new,
// then the force is held, from 5 to 20 ms it fades, then it is a fault. Any thread, flops.
#pragma once

#include <algorithm>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class Staleness {
 public:
  struct Output {
    bool holds = false;    ///< the force is held or fading
    bool overdue = false;  ///< too old: a fault
    double share = 1.0;    ///< of the force held
  };

  /// `elapsed_s` since the last call.
  Output update(bool fresh, const SafetyThresholds& t, double elapsed_s) noexcept {
    age_s_ = fresh ? 0.0 : age_s_ + elapsed_s;
    const double left = (t.max_stale_s - age_s_) / std::max(t.max_stale_s - t.stale_fade_s, 1e-9);
    // Tolerances for the rounding of a sum of ticks.
    return {age_s_ > t.stale_s * (1.0 + 1e-9), left < 1e-9, std::clamp(left, 0.0, 1.0)};
  }

 private:
  double age_s_ = 0.0;
};

}  // namespace haptics
