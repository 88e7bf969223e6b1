// Rotations as vectors along their axis, as long as their angle: what fits and random draws count them in. rad. Pure;
// any thread.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace calibration {

inline glm::dquat rotationFromVector(const glm::dvec3& turn_rad) {
  const double angle_rad = glm::length(turn_rad);
  return angle_rad > 0.0 ? glm::angleAxis(angle_rad, turn_rad / angle_rad) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// From one to the other, 0 to pi; exact where they are nearly the same.
inline double angleBetween_rad(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::conjugate(a) * b;
  return 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

}  // namespace calibration
