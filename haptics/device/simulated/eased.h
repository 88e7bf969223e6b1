// From rest to rest: how far a way is gone at a part of its time. Pure.
#pragma once

#include <algorithm>

namespace haptics {

/// 0..1 of the time to 0..1 of the way, still at both ends; beyond them as there.
constexpr double eased(double part) {
  const double u = std::clamp(part, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

}  // namespace haptics
