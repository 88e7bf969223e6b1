// A signed distance (negative inside) stored on a cubic lattice, so that costly shapes are evaluated once.
// mm, in the frame of whoever fills it. Immutable once built; any thread may read. Building is parallel and does not
// depend on the number of threads. Outside its box the distance grows by the way to the box: a lower-quality but safe
// bound. Redistancing: fast sweeping for |grad d| = 1 (Zhao, Math. Comp. 74, 2005) around sub-voxel interface values.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

struct LatticeBox {
  glm::dvec3 low_mm{0.0};
  glm::dvec3 high_mm{0.0};
};

class DistanceLattice {
 public:
  using Shape = std::function<double(const glm::dvec3& point_mm)>;

  DistanceLattice(const LatticeBox& box, double spacing_mm, const Shape& shape);

  /// Replaces the values by true distances to the zero surface.
  void redistance();

  /// Trilinear: keeps detail. About 10 ns.
  double at(const glm::dvec3& point_mm) const;
  /// No point of the zero surface is nearer than this (within interpolation error), inside the box or outside.
  double lowerBound_mm(const glm::dvec3& point_mm) const;
  /// Cubic B-spline: twice differentiable, rounds detail finer than a lattice step. About 60 ns.
  double smoothAt(const glm::dvec3& point_mm) const;

  /// Points on the zero surface, about one per lattice edge that crosses it.
  std::vector<glm::dvec3> surfacePoints_mm() const;

  const LatticeBox& box() const { return box_; }

 private:
  std::size_t index(int i, int j, int k) const;
  double clampToBox(const glm::dvec3& point_mm, glm::dvec3& lattice_coordinates) const;

  LatticeBox box_;
  double spacing_mm_;
  glm::ivec3 size_;
  std::vector<float> value_;
};

}  // namespace assets
