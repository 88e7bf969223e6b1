// How old what we know of the hand is, and how much force is left of it (reference/devices 6.9): 3 ms as if it were
// new, then the force is held, from 5 to 20 ms it fades, and then it is a fault. A state of one number; any thread,
// flops.
#pragma once

#include <algorithm>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class Staleness {
 public:
  struct Output {
    bool holds = false;    ///< the force is held, or what is left of it
    bool overdue = false;  ///< too long: a fault
    double share = 1.0;    ///< of the force held
  };

  /// `elapsed_s` since the last call, by the clock where that knows better.
  Output follow(bool fresh, const SafetyThresholds& t, double elapsed_s) noexcept {
    age_s_ = fresh ? 0.0 : age_s_ + elapsed_s;
    const double left = (t.max_stale_s - age_s_) / std::max(t.max_stale_s - t.stale_fade_s, 1e-9);
    // A sum of ticks reaches its end but for rounding.
    return {age_s_ > t.stale_s * (1.0 + 1e-9), left < 1e-9, std::clamp(left, 0.0, 1.0)};
  }

 private:
  double age_s_ = 0.0;
};

}  // namespace haptics
