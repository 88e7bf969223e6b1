// The target of a simulated hand over time: pose of the handle in D, pedal and buttons, and whether it grips. mm, s. A
// script is a pure function of time that the device's thread calls twice a tick: no allocation, no lock.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace haptics {

struct HandTarget {
  glm::dvec3 position_mm{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  bool pedal = false;
  std::uint32_t buttons = 0;  ///< of the handle; bit 0: the first
  bool grips = true;          ///< false: the hand has let go of the handle
};

/// Fraction of the time, 0..1, to fraction of the way, with velocity 0 at both ends; clamped beyond them.
constexpr double eased(double part) {
  const double u = std::clamp(part, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

using HandScript = std::function<HandTarget(double t_s)>;

}  // namespace haptics
