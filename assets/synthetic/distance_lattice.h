// Signed distance (negative inside) sampled on a cubic lattice, so that costly shapes are evaluated once. mm, frame of
// the shape. Immutable once built; any thread may read. Parallel build, independent of the number of threads. Outside
// the box the distance to the box is added: a bound of lower quality. Redistancing: fast sweeping for |grad d| = 1
// (Zhao, Math. Comp. 74, 2005) from sub-voxel interface values.
#pragma once

#include <functional>
#include <vector>

#include "assets/synthetic/implicit_shape.h"

namespace assets {

class DistanceLattice {
 public:
  using Shape = std::function<double(const glm::dvec3& point_mm)>;

  DistanceLattice(const BoundingBox& box, double spacing_mm, const Shape& shape);

  /// Replaces the values by true distances to the zero surface.
  void redistance();

  /// Trilinear; about 10 ns.
  double at(const glm::dvec3& point_mm) const;
  /// Lower bound of the distance to the zero surface, inside the box or outside.
  double lowerBound_mm(const glm::dvec3& point_mm) const;
  /// Cubic B-spline: twice differentiable, smooths detail below a lattice step; about 60 ns.
  double smoothAt(const glm::dvec3& point_mm) const;

  /// One point of the zero surface per lattice edge that crosses it.
  std::vector<glm::dvec3> surfacePoints_mm() const;

 private:
  std::size_t index(int i, int j, int k) const;
  double clampToBox(const glm::dvec3& point_mm, glm::dvec3& lattice_coordinates) const;

  BoundingBox box_;
  double spacing_mm_;
  glm::ivec3 size_;
  std::vector<float> value_;
};

}  // namespace assets
