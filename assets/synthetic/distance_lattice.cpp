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
double eikonalUpdate(double x_mm, double y_mm, double z_mm, double step_mm) {
  const double low = std::min(x_mm, y_mm), high = std::max(x_mm, y_mm);
  const double a = std::min(low, z_mm), c = std::max(high, z_mm), b = std::max(low, std::min(high, z_mm));
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
  const std::ptrdiff_t row = size_.x, slice = row * size_.y;
  for (int sweep = 0; sweep < 8; ++sweep) {
    const auto order = [](bool up, int n, int count) { return up ? n : count - 1 - n; };
    for (int kk = 0; kk < size_.z; ++kk)
      for (int jj = 0; jj < size_.y; ++jj) {
        const int j = order((sweep & 2) != 0, jj, size_.y);
        const int k = order((sweep & 4) != 0, kk, size_.z);
        // Steps to the neighbours; at the box's edge the point itself stands for the one beyond.
        const std::ptrdiff_t down = k > 0 ? -slice : 0, up = k + 1 < size_.z ? slice : 0;
        const std::ptrdiff_t front = j > 0 ? -row : 0, back = j + 1 < size_.y ? row : 0;
        float* const line = distance.data() + index(0, j, k);
        const char* const line_fixed = fixed.data() + index(0, j, k);
        for (int ii = 0; ii < size_.x; ++ii) {
          const int i = order((sweep & 1) != 0, ii, size_.x);
          if (line_fixed[i]) continue;
          float* const here = line + i;
          const auto nearer = [here](std::ptrdiff_t less, std::ptrdiff_t more) {
            return static_cast<double>(std::min(here[less], here[more]));
          };
          const double d = eikonalUpdate(nearer(i > 0 ? -1 : 0, i + 1 < size_.x ? 1 : 0), nearer(front, back),
                                         nearer(down, up), spacing_mm_);
          *here = std::min(*here, static_cast<float>(d));
        }
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
  // Where each of the four samples along an axis lies in its line, line in its plane, and plane.
  std::array<std::size_t, 4> x{}, y{}, z{};
  for (int n = 0; n < 4; ++n) {
    const auto at = static_cast<std::size_t>(n);
    x[at] = index(std::clamp(cell.x + n - 1, 0, size_.x - 1), 0, 0);
    y[at] = index(0, std::clamp(cell.y + n - 1, 0, size_.y - 1), 0);
    z[at] = index(0, 0, std::clamp(cell.z + n - 1, 0, size_.z - 1));
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    double plane = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      const float* const v = value_.data() + z[k] + y[j];
      double line = 0.0;
      for (std::size_t i = 0; i < 4; ++i) line += wx[i] * static_cast<double>(v[x[i]]);
      plane += wy[j] * line;
    }
    sum += wz[k] * plane;
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
