// Rotation vectors: axis times angle, rad. Pure; any thread.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace calibration {

inline glm::dquat rotationFromVector(const glm::dvec3& rotation_rad) {
  const double angle_rad = glm::length(rotation_rad);
  return angle_rad > 0.0 ? glm::angleAxis(angle_rad, rotation_rad / angle_rad) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// [v]x: crossMatrix(v) * w = v x w.
inline glm::dmat3 crossMatrix(const glm::dvec3& v) { return {0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0}; }

/// 0 to pi, accurate for small angles.
inline double angleBetween_rad(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat rotation = glm::conjugate(a) * b;
  return 2.0 * std::atan2(glm::length(glm::dvec3(rotation.x, rotation.y, rotation.z)), std::abs(rotation.w));
}

}  // namespace calibration
