// Exponential and arc sine in double from their series: the same bits with any mathematics library, so that a recorded
// session replays anywhere. Relative error below 1e-12. Any thread; 20 ns.
#pragma once

#include <cmath>

namespace haptics {

/// -60 <= x <= 60.
inline double exponentialOf(double x) noexcept {
  // e^x = (e^(x/256))^256
  const double part = x / 256.0;
  double sum = 1.0;
  for (int n = 9; n > 0; --n) sum = 1.0 + part / n * sum;
  for (int n = 0; n < 8; ++n) sum *= sum;
  return sum;
}

/// 0 <= s <= 1.
inline double arcSineOf(double s) noexcept {
  // Halve the angle four times: below 0.1 rad the series ends soon.
  double doubled = 1.0;
  for (int n = 0; n < 4; ++n) {
    s /= std::sqrt(2.0 * (1.0 + std::sqrt(std::fmax(0.0, 1.0 - s * s))));
    doubled *= 2.0;
  }
  const double s2 = s * s;
  return doubled * s * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0 + s2 * (15.0 / 336.0 + s2 * (105.0 / 3456.0)))));
}

}  // namespace haptics
