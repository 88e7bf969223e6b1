#include "assets/segment/tubeness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "assets/segment/cell_filters.h"

namespace assets {
namespace {

/// Middle and least eigenvalue of a symmetric matrix in closed form (Smith 1961).
std::array<double, 2> lowerEigenvalues(double xx, double xy, double xz, double yy, double yz, double zz) {
  const double mean = (xx + yy + zz) / 3.0, off = xy * xy + xz * xz + yz * yz;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double spread = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0) + 1e-6;
  const double determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double angle = std::acos(std::clamp(0.5 * determinant / (spread * spread * spread), -1.0, 1.0)) / 3.0;
  const double most = mean + 2.0 * spread * std::cos(angle);
  const double least = mean + 2.0 * spread * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
  return {3.0 * mean - most - least, least};
}

}  // namespace

std::vector<float> darkTubeness(glm::ivec3 size, double sigma_cells, const std::vector<float>& values) {
  const auto second = [&](int axis, int other) { return secondDerivative(size, sigma_cells, values, axis, other); };
  const std::vector<float> xx = second(0, 0), xy = second(0, 1), xz = second(0, 2), yy = second(1, 1),
                           yz = second(1, 2), zz = second(2, 2);
  std::vector<float> tube(values.size());
  tbb::parallel_for(std::size_t{0}, tube.size(), [&](std::size_t n) {
    const auto [middle, least] =
        lowerEigenvalues(static_cast<double>(xx[n]), static_cast<double>(xy[n]), static_cast<double>(xz[n]),
                         static_cast<double>(yy[n]), static_cast<double>(yz[n]), static_cast<double>(zz[n]));
    const double value = middle > 0.0 ? middle - 0.5 * std::abs(least) : 0.0;
    tube[n] = static_cast<float>(sigma_cells * sigma_cells * value);
  });
  return tube;
}

}  // namespace assets
