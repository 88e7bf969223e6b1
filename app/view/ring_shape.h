// The shape of the ring of instruments, the same for who chooses (app/controls/tool_ring) and who draws
// (tool_ring_panel). Shares of the screen's height, y downwards. Pure.
#pragma once

#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "calibration/geometry/units.h"

namespace app {

/// Radii: nothing is chosen within the first; of the ring.
inline constexpr double kRingMiddle = 0.035, kRingRadius = 0.17;

/// Of instrument n of so many, from the middle: unit. The first stands at the top, the others clockwise.
inline glm::dvec2 ringDirection(std::size_t n, std::size_t tools) {
  const double angle = 2.0 * calibration::kPi * static_cast<double>(n) / static_cast<double>(tools);
  return {std::sin(angle), -std::cos(angle)};
}

}  // namespace app
