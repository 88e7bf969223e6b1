// Limit by the motors' heat (reference/devices 6.7): a bucket of F^2 t that drains at r = 0.7 C^2 and holds 3 s C^2, so
// that over any 10 s
//   integral F^2 dt <= 3 s C^2 + 10 s r = 10 s C^2     root mean square <= C, the continuous force, exactly
//   F^2 <= r + left / 0.2 s                            falls without a step, never below 0.84 C
// From cold a Touch (C = 0.88 N) gives its 3.3 N for 20 ms, 2 N for a quarter of a second, 0.74 N for ever. The
// device's own motor heat counts as well: from 0.8 to 1 the force is lowered linearly to 0.3. Servo thread, flops.
// Torque is not counted.
#pragma once

#include <algorithm>
#include <cmath>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class ThermalBudget {
 public:
  static constexpr double kWindow_s = 10.0, kSustained = 0.7, kFade_s = 0.2;

  double maxForce_N(double continuous_N) const noexcept {
    const double square = continuous_N * continuous_N;
    const double left = std::max(0.0, (1.0 - kSustained) * kWindow_s * square - spent_N2s_);
    return std::sqrt(kSustained * square + left / kFade_s);
  }

  void spend(double force_N, double continuous_N, double dt_s) noexcept {
    spent_N2s_ = std::max(0.0, spent_N2s_ + (force_N * force_N - kSustained * continuous_N * continuous_N) * dt_s);
  }

 private:
  double spent_N2s_ = 0.0;
};

/// Share of the force at this heat of the warmest motor; NaN counts as 1.
inline double shareAtHeat(double heat, const SafetyThresholds& t) noexcept {
  const double hot = heat < 1.0 ? std::max(0.0, heat - t.warm_motor) / std::max(1.0 - t.warm_motor, 1e-9) : 1.0;
  return 1.0 - (1.0 - t.share_at_hottest) * std::min(hot, 1.0);
}

}  // namespace haptics
