// Smooth step between two positions at rest. Pure.
#pragma once

#include <algorithm>

namespace haptics {

/// Fraction of the time, 0..1, to fraction of the way, with velocity 0 at both ends; clamped beyond them.
constexpr double eased(double part) {
  const double u = std::clamp(part, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

}  // namespace haptics
