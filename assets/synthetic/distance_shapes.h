// The solids the synthetic face is modelled from: signed distances in mm, negative inside
// (joined softly by implicit_shape.h).
// Frame of whoever calls. Any thread; a few flops each. Ellipsoids are first-order distances: right at the surface,
// within a factor of the axis ratio elsewhere. Formulas after Quilez, "distance functions" (2008-2013).
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "assets/synthetic/implicit_shape.h"

namespace assets {

inline double ball(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return glm::length(p - centre) - radius;
}

inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
  const glm::dvec3 q = (p - centre) / radii;
  const double k0 = glm::length(q);
  const double k1 = glm::length(q / radii);
  return k1 < 1e-9 ? -std::min({radii.x, radii.y, radii.z}) : k0 * (k0 - 1.0) / k1;
}

/// A capsule whose radius goes from `ra` at a to `rb` at b.
inline double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb) {
  const glm::dvec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - t * ab) - glm::mix(ra, rb, t);
}

/// Rotation about x: positive turns y toward z.
inline glm::dvec3 rotatedAboutX(const glm::dvec3& p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

/// A bump of height 1 and about `width` mm across, round in all directions.
inline double bump(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& width) {
  const glm::dvec3 q = (p - centre) / width;
  return std::exp(-glm::dot(q, q));
}

}  // namespace assets
