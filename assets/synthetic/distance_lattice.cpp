#include "assets/synthetic/distance_lattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/volume_grid.h"

namespace assets {
namespace {

/// Weights of the uniform cubic B-spline at fraction t of a cell.
std::array<double, 4> splineWeights(double t) {
  const double u = 1.0 - t;
  return {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
          t * t * t / 6.0};
}

/// Godunov solution of |grad d| = 1 from the smallest neighbour along each axis.
double eikonalUpdate(std::array<double, 3> neighbour_mm, double step_mm) {
  std::sort(neighbour_mm.begin(), neighbour_mm.end());
  const auto [a, b, c] = neighbour_mm;
  double d = a + step_mm;
  if (d <= b) return d;
  d = 0.5 * (a + b + std::sqrt(std::max(0.0, 2.0 * step_mm * step_mm - (a - b) * (a - b))));
  if (d <= c) return d;
  const double sum = a + b + c;
  const double square = a * a + b * b + c * c;
  return (sum + std::sqrt(std::max(0.0, sum * sum - 3.0 * (square - step_mm * step_mm)))) / 3.0;
}

}  // namespace

DistanceLattice::DistanceLattice(const BoundingBox& box, double spacing_mm, const Shape& shape)
    : box_(box), spacing_mm_(spacing_mm) {
  size_ = glm::ivec3(glm::ceil((box.high_mm - box.low_mm) / spacing_mm)) + 1;
  box_.high_mm = box_.low_mm + spacing_mm * glm::dvec3(size_ - 1);
  value_.resize(countIn(size_));
  tbb::parallel_for(0, size_.z, [&](int k) {
    for (int j = 0; j < size_.y; ++j)
      for (int i = 0; i < size_.x; ++i)
        value_[index(i, j, k)] = static_cast<float>(shape(box_.low_mm + spacing_mm * glm::dvec3(i, j, k)));
  });
}

std::size_t DistanceLattice::index(int i, int j, int k) const { return indexIn(size_, {i, j, k}); }

void DistanceLattice::redistance() {
  constexpr float kFar_mm = 1e6f;
  std::vector<float> distance(value_.size(), kFar_mm);
  std::vector<char> fixed(value_.size(), 0);

  // At the surface: value over gradient, first order and sub-voxel.
  tbb::parallel_for(0, size_.z, [&](int k) {
    for (int j = 0; j < size_.y; ++j)
      for (int i = 0; i < size_.x; ++i) {
        const std::array<int, 3> at{i, j, k};
        const double here = static_cast<double>(value_[index(i, j, k)]);
        bool crosses = false;
        double gradient_squared = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> less = at, more = at;
          less[axis] = std::max(0, at[axis] - 1);
          more[axis] = std::min(size_[static_cast<int>(axis)] - 1, at[axis] + 1);
          const double a = static_cast<double>(value_[index(less[0], less[1], less[2])]);
          const double b = static_cast<double>(value_[index(more[0], more[1], more[2])]);
          crosses = crosses || (a < 0.0) != (here < 0.0) || (b < 0.0) != (here < 0.0);
          const double slope = (b - a) / (spacing_mm_ * static_cast<double>(more[axis] - less[axis]));
          gradient_squared += slope * slope;
        }
        if (!crosses) continue;
        fixed[index(i, j, k)] = 1;
        const double gradient = std::sqrt(std::max(gradient_squared, 0.04));
        distance[index(i, j, k)] =
            static_cast<float>(std::min(std::abs(here) / gradient, std::sqrt(3.0) * spacing_mm_));
      }
  });

  // Elsewhere: one sweep in each of eight orders.
  for (int sweep = 0; sweep < 8; ++sweep) {
    const auto order = [](bool up, int n, int count) { return up ? n : count - 1 - n; };
    for (int kk = 0; kk < size_.z; ++kk)
      for (int jj = 0; jj < size_.y; ++jj)
        for (int ii = 0; ii < size_.x; ++ii) {
          const int i = order((sweep & 1) != 0, ii, size_.x);
          const int j = order((sweep & 2) != 0, jj, size_.y);
          const int k = order((sweep & 4) != 0, kk, size_.z);
          if (fixed[index(i, j, k)]) continue;
          const auto nearer = [&](int di, int dj, int dk) {
            const float a = distance[index(std::max(0, i - di), std::max(0, j - dj), std::max(0, k - dk))];
            const float b = distance[index(std::min(size_.x - 1, i + di), std::min(size_.y - 1, j + dj),
                                           std::min(size_.z - 1, k + dk))];
            return static_cast<double>(std::min(a, b));
          };
          const double d = eikonalUpdate({nearer(1, 0, 0), nearer(0, 1, 0), nearer(0, 0, 1)}, spacing_mm_);
          float& stored = distance[index(i, j, k)];
          stored = std::min(stored, static_cast<float>(d));
        }
  }
  for (std::size_t n = 0; n < value_.size(); ++n) value_[n] = value_[n] < 0.0f ? -distance[n] : distance[n];
}

double DistanceLattice::clampToBox(const glm::dvec3& point_mm, glm::dvec3& lattice_coordinates) const {
  const glm::dvec3 inside = glm::clamp(point_mm, box_.low_mm, box_.high_mm);
  lattice_coordinates = (inside - box_.low_mm) / spacing_mm_;
  return glm::distance(inside, point_mm);
}

double DistanceLattice::at(const glm::dvec3& point_mm) const {
  glm::dvec3 c;
  const double outside_mm = clampToBox(point_mm, c);
  const glm::ivec3 cell = glm::min(glm::ivec3(c), size_ - 2);
  const glm::dvec3 t = c - glm::dvec3(cell);
  const float* v = value_.data() + index(cell.x, cell.y, cell.z);
  const auto row = static_cast<std::size_t>(size_.x);
  const auto slice = row * static_cast<std::size_t>(size_.y);
  const auto along = [&](std::size_t offset) {
    const double a = static_cast<double>(v[offset]);
    return a + t.x * (static_cast<double>(v[offset + 1]) - a);
  };
  const double low = along(0) + t.y * (along(row) - along(0));
  const double high = along(slice) + t.y * (along(slice + row) - along(slice));
  return low + t.z * (high - low) + outside_mm;
}

double DistanceLattice::lowerBound_mm(const glm::dvec3& point_mm) const {
  const double outside_mm = glm::distance(glm::clamp(point_mm, box_.low_mm, box_.high_mm), point_mm);
  if (outside_mm == 0.0) return at(point_mm);
  return std::max(outside_mm, at(point_mm) - 2.0 * outside_mm);
}

double DistanceLattice::smoothAt(const glm::dvec3& point_mm) const {
  glm::dvec3 c;
  const double outside_mm = clampToBox(point_mm, c);
  const glm::ivec3 cell = glm::min(glm::ivec3(c), size_ - 2);
  const auto wx = splineWeights(c.x - cell.x), wy = splineWeights(c.y - cell.y), wz = splineWeights(c.z - cell.z);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    double plane = 0.0;
    for (int j = 0; j < 4; ++j) {
      double line = 0.0;
      const int y = std::clamp(cell.y + j - 1, 0, size_.y - 1), z = std::clamp(cell.z + k - 1, 0, size_.z - 1);
      for (int i = 0; i < 4; ++i)
        line += wx[static_cast<std::size_t>(i)] *
                static_cast<double>(value_[index(std::clamp(cell.x + i - 1, 0, size_.x - 1), y, z)]);
      plane += wy[static_cast<std::size_t>(j)] * line;
    }
    sum += wz[static_cast<std::size_t>(k)] * plane;
  }
  return sum + outside_mm;
}

std::vector<glm::dvec3> DistanceLattice::surfacePoints_mm() const {
  std::vector<glm::dvec3> points;
  for (int k = 0; k + 1 < size_.z; ++k)
    for (int j = 0; j + 1 < size_.y; ++j)
      for (int i = 0; i + 1 < size_.x; ++i) {
        const double here = static_cast<double>(value_[index(i, j, k)]);
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 step(0);
          step[axis] = 1;
          const double next = static_cast<double>(value_[index(i + step.x, j + step.y, k + step.z)]);
          if ((here < 0.0) == (next < 0.0)) continue;
          const double t = here / (here - next);
          points.push_back(box_.low_mm + spacing_mm_ * (glm::dvec3(i, j, k) + t * glm::dvec3(step)));
        }
      }
  return points;
}

}  // namespace assets
