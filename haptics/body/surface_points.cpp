#include "haptics/body/surface_points.h"

#include <algorithm>
#include <cmath>

namespace haptics {

SurfacePoints surfacePoints(const DistanceField& piece, const glm::dvec3& origin_mm, double step_mm) {
  SurfacePoints points;
  points.area_mm2 = static_cast<float>(step_mm * step_mm);
  const assets::VolumeGrid& grid = piece.grid();
  const glm::dvec3 low_mm = grid.origin_P_mm, high_mm = grid.centre_P_mm(grid.size - 1);
  const glm::ivec3 first(glm::ceil((low_mm - origin_mm) / step_mm)), last(glm::floor((high_mm - origin_mm) / step_mm));
  assets::forVoxels(first, last + 1, [&](glm::ivec3 lattice) {
    const glm::dvec3 p_mm = step_mm * glm::dvec3(lattice);
    const DistanceField::Sample there = piece.at(glm::vec3(grid.indexFromPoint(origin_mm + p_mm)));
    if (there.distance_mm > 0.0F || static_cast<double>(there.distance_mm) < -step_mm) return;
    points.at_mm.push_back(glm::vec3(p_mm) - there.distance_mm * there.gradient);
  });
  return points;
}

namespace {

/// visit(arm from the placement's origin, field there, depth) of the points that are deeper than the play.
template <class Visit>
void forDeep(const SurfacePoints& points, const Placement& placement, const DistanceField& obstacles, double play_mm,
             const Visit& visit) {
  const assets::VolumeGrid& grid = obstacles.grid();
  const float per_mm = static_cast<float>(1.0 / grid.spacing_mm), play = static_cast<float>(play_mm);
  const float clear_mm = 0.87F * static_cast<float>(grid.spacing_mm) - play;
  const glm::mat3 R(glm::mat3_cast(placement.rotation));
  const glm::vec3 origin(grid.indexFromPoint(placement.at_mm));
  for (const glm::vec3& p_mm : points.at_mm) {
    const glm::vec3 arm_mm = R * p_mm, index = origin + per_mm * arm_mm;
    if (obstacles.near(index) > clear_mm) continue;
    const DistanceField::Sample there = obstacles.at(index);
    const float depth_mm = -there.distance_mm - play;
    if (depth_mm > 0.0F) visit(arm_mm, there, static_cast<double>(depth_mm));
  }
}

}  // namespace

double overlap_mm3(const SurfacePoints& points, const Placement& placement, const DistanceField& obstacles,
                   double play_mm) {
  double depths_mm = 0.0;
  forDeep(points, placement, obstacles, play_mm,
          [&](const glm::vec3&, const DistanceField::Sample&, double depth_mm) { depths_mm += depth_mm; });
  return static_cast<double>(points.area_mm2) * depths_mm;
}

Overlap overlapOf(const SurfacePoints& points, const Placement& placement, const DistanceField& obstacles,
                  double play_mm) {
  const double weight = static_cast<double>(points.area_mm2);
  Overlap sum;
  forDeep(points, placement, obstacles, play_mm,
          [&](const glm::vec3& arm_mm, const DistanceField::Sample& there, double depth_mm) {
            sum.volume_mm3 += weight * depth_mm;
            const glm::dvec3 out(there.gradient), turn(glm::cross(arm_mm, there.gradient));
            const Vector6 rate = {out.x, out.y, out.z, turn.x, turn.y, turn.z};
            for (std::size_t row = 0; row < 6; ++row) {
              sum.gradient[row] -= weight * depth_mm * rate[row];
              for (std::size_t column = row; column < 6; ++column)
                sum.hessian[row][column] += weight * rate[row] * rate[column];
            }
          });
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < row; ++column) sum.hessian[row][column] = sum.hessian[column][row];
  return sum;
}

Vector6 pushOut(const Overlap& overlap, double damping) {
  constexpr double kTurnArm2_mm2 = 25.0;
  std::array<Vector6, 6> m = overlap.hessian;
  double largest = 1e-3;
  for (std::size_t n = 0; n < 6; ++n) largest = std::max(largest, m[n][n] / (n < 3 ? 1.0 : kTurnArm2_mm2));
  for (std::size_t n = 0; n < 6; ++n) m[n][n] += damping * largest * (n < 3 ? 1.0 : kTurnArm2_mm2);

  // Cholesky: the matrix is positive by its damping.
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column <= row; ++column) {
      double rest = m[row][column];
      for (std::size_t n = 0; n < column; ++n) rest -= m[row][n] * m[column][n];
      m[row][column] = row == column ? std::sqrt(std::max(rest, 1e-12)) : rest / m[column][column];
    }
  Vector6 step{};
  for (std::size_t row = 0; row < 6; ++row) {
    double rest = -overlap.gradient[row];
    for (std::size_t n = 0; n < row; ++n) rest -= m[row][n] * step[n];
    step[row] = rest / m[row][row];
  }
  for (std::size_t row = 6; row-- > 0;) {
    for (std::size_t n = row + 1; n < 6; ++n) step[row] -= m[n][row] * step[n];
    step[row] /= m[row][row];
  }
  return step;
}

}  // namespace haptics
