// Distance from a point to a straight segment, in two or three dimensions. Pure; any thread.
#pragma once

#include <glm/glm.hpp>

namespace calibration {

/// From point `p` to segment ab, which may be a point.
template <class Vector>
double distanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? glm::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

}  // namespace calibration
