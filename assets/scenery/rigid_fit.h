// The rotation and shift that bring one set of points onto another, in the least squares sense, never scaled.
// Closed form by unit quaternions (Horn, J. Opt. Soc. Am. A 4, 1987); the largest eigenvector by Jacobi rotations.
// Frames in the type; mm. Any thread; a few microseconds. No outliers: leave them out before.
#pragma once

#include <span>

#include "calibration/geometry/pose.h"

namespace assets {

struct PointPair {
  glm::dvec3 to_mm{0.0};
  glm::dvec3 from_mm{0.0};
  double weight = 1.0;
};

/// At least three pairs that do not lie on one line.
struct RigidMotion {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 translation_mm{0.0};
};

RigidMotion rigidFit(std::span<const PointPair> pairs);

}  // namespace assets
