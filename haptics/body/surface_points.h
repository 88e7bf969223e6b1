// Points on the surface of a piece, each standing for an area of it, against the distance field of what is around:
// how far they are in, and which way out. mm. Any thread; 5 ns a point that is clear, 25 ns for one that is not.
// Penalty k/2 A depth^2 with k = 1 N/mm^3; Hessian by Gauss and Newton, so never negative (reference/extraction 4.2).
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "haptics/body/distance_field.h"

namespace haptics {

struct SurfacePoints {
  std::vector<glm::vec3> at_mm;  ///< about an origin of the caller's choice
  float area_mm2 = 0.0F;         ///< of each
};

/// Where points of a lattice that lie up to `step_mm` inside the surface fall on it. About `origin_mm` of the field's
/// frame. The field's band must reach step_mm.
SurfacePoints surfacePoints(const DistanceField& piece, const glm::dvec3& origin_mm, double step_mm);

/// Of the origin of the points in the frame of the obstacles.
struct Placement {
  glm::dvec3 at_mm{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};

  /// Moved, and turned about its origin by a small rotation vector (axes of the obstacles; |tan| half the angle).
  Placement moved(const glm::dvec3& by_mm, const glm::dvec3& turn_rad) const {
    const glm::dquat turn = glm::normalize(glm::dquat(1.0, 0.5 * turn_rad));
    return {at_mm + by_mm, glm::normalize(turn * rotation)};
  }
};

/// First three: along the axes; last three: about them.
using Vector6 = std::array<double, 6>;

struct Overlap {
  double volume_mm3 = 0.0;  ///< area times depth
  Vector6 gradient{};       ///< of the penalty
  std::array<Vector6, 6> hessian{};
};

/// Points deeper than `play_mm`.
double overlap_mm3(const SurfacePoints& points, const Placement& placement, const DistanceField& obstacles,
                   double play_mm);
/// The same with its slope.
Overlap overlapOf(const SurfacePoints& points, const Placement& placement, const DistanceField& obstacles,
                  double play_mm);

/// The step -H^-1 g with `damping` times the largest diagonal element added, where turns weigh as lengths at 5 mm.
/// Zero: nothing to solve.
Vector6 pushOut(const Overlap& overlap, double damping);

}  // namespace haptics
