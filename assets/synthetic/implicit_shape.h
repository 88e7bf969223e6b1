// Signed distances (negative inside) of the synthetic anatomy: smooth set operations, profiles, solids, polygons.
// mm in, mm out, any frame; `blend_mm` is the width of a smooth transition. Any thread; a few flops each. Smooth
// minimum and solids after Quilez (2008-2013): exact outside the blend, at most blend/4 too deep inside it; ellipsoids
// are exact at the surface, within a factor of the axis ratio elsewhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/glm.hpp>

#include "assets/smooth_distance.h"

namespace assets {

struct BoundingBox {
  glm::dvec3 low_mm{0.0};
  glm::dvec3 high_mm{0.0};
};

/// 0 below `from`, 1 above `to`, C1 between; `from` may exceed `to`.
inline double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

struct ProfileKnot {
  double at = 0.0;
  double value = 0.0;
};

/// Cubic Hermite interpolation through ascending knots, slopes by finite differences, constant beyond the ends.
inline double profile(std::span<const ProfileKnot> knots, double at) {
  if (at <= knots.front().at) return knots.front().value;
  if (at >= knots.back().at) return knots.back().value;
  std::size_t i = 0;
  while (at > knots[i + 1].at) ++i;
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k + 1 == knots.size()) return 0.0;
    return (knots[k + 1].value - knots[k - 1].value) / (knots[k + 1].at - knots[k - 1].at);
  };
  const double width = knots[i + 1].at - knots[i].at;
  const double t = (at - knots[i].at) / width;
  const double u = 1.0 - t;
  return u * u * ((1.0 + 2.0 * t) * knots[i].value + t * width * slope(i)) +
         t * t * ((3.0 - 2.0 * t) * knots[i + 1].value - u * width * slope(i + 1));
}

/// Parameter 0..1 of the point nearest to p on the segment from a to b.
template <class Vector>
double nearestOnSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector edge = b - a;
  return std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
}

/// Signed distance to a closed polygon.
inline double polygonDistance_mm(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
  double squared = 1e30;
  bool inside = false;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec2 a = polygon[n], b = polygon[(n + 1) % polygon.size()], edge = b - a;
    const glm::dvec2 offset = p - a - nearestOnSegment(p, a, b) * edge;
    squared = std::min(squared, glm::dot(offset, offset));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * edge.x) inside = !inside;
  }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

inline double ball(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return glm::length(p - centre) - radius;
}

inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
  const glm::dvec3 q = (p - centre) / radii;
  const double k0 = glm::length(q);
  const double k1 = glm::length(q / radii);
  return k1 < 1e-9 ? -std::min({radii.x, radii.y, radii.z}) : k0 * (k0 - 1.0) / k1;
}

/// Capsule with radius `ra` at a and `rb` at b.
inline double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb) {
  const double t = nearestOnSegment(p, a, b);
  return glm::length(p - a - t * (b - a)) - glm::mix(ra, rb, t);
}

/// Rotation about x, positive from y to z.
inline glm::dvec3 rotatedAboutX(const glm::dvec3& p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

/// Gaussian bump of height 1, about `width` mm across.
inline double bump(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& width) {
  const glm::dvec3 q = (p - centre) / width;
  return std::exp(-glm::dot(q, q));
}

}  // namespace assets
