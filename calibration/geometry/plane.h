// An oriented plane n.x = offset and reflection in it. mm, frame in the type. Any thread; a few flops.
#pragma once

#include "calibration/geometry/pose.h"

namespace calibration {

template <class A>
struct Plane {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit length
  double offset_mm = 0.0;

  double distance_mm(const Point<A>& p) const { return glm::dot(normal, p.mm) - offset_mm; }

  /// R(x) = x - 2 (n.x - d) n; its own inverse.
  Point<A> reflect(const Point<A>& p) const { return {p.mm - 2.0 * distance_mm(p) * normal}; }
};

}  // namespace calibration
