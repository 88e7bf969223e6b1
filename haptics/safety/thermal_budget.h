// What the motors' heat allows (reference/devices 6.7). A bucket of F^2 t, of which r = 0.7 C^2 flows off all the time
// and which holds 3 s C^2, so that over any 10 s
//   integral F^2 dt <= 3 s C^2 + 10 s r = 10 s C^2     root mean square <= C, the continuous force, exactly
//   F^2 <= r + left / 0.2 s                            goes down without a step, never below 0.84 C
// From cold a Touch (C = 0.88 N) gives its 3.3 N for 20 ms, 2 N for a quarter of a second, 0.74 N for ever. What the
// device says of its warmest motor counts besides: from 0.8 on the force is lowered in a line to 0.3 of it at 1.
// Servo thread, flops. Torque is not counted.
#pragma once

#include <algorithm>
#include <cmath>

#include "haptics/safety/safety_limits.h"

namespace haptics {

class ThermalBudget {
 public:
  static constexpr double kWindow_s = 10.0, kAlways = 0.7, kFade_s = 0.2;

  double maxForce_N(double continuous_N) const noexcept {
    const double square = continuous_N * continuous_N;
    const double left = std::max(0.0, (1.0 - kAlways) * kWindow_s * square - spent_N2s_);
    return std::sqrt(kAlways * square + left / kFade_s);
  }

  void spend(double force_N, double continuous_N, double dt_s) noexcept {
    spent_N2s_ = std::max(0.0, spent_N2s_ + (force_N * force_N - kAlways * continuous_N * continuous_N) * dt_s);
  }

 private:
  double spent_N2s_ = 0.0;
};

/// Of the force, at this heat of the warmest motor; a heat that is no number counts as the hottest.
inline double shareAtHeat(double heat, const SafetyThresholds& t) noexcept {
  const double hot = heat < 1.0 ? std::max(0.0, heat - t.warm_motor) / std::max(1.0 - t.warm_motor, 1e-9) : 1.0;
  return 1.0 - (1.0 - t.share_at_hottest) * std::min(hot, 1.0);
}

}  // namespace haptics
