#include "assets/segment/cell_filters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace assets {
namespace {

/// A Gaussian or its derivative, from -reach to reach; exact for polynomials up to the second degree although it is
/// cut.
std::vector<float> gaussianTaps(double sigma, int order) {
  const int reach = std::max(1, static_cast<int>(3.0 * sigma + 0.5));
  std::vector<double> weights;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (int d = -reach; d <= reach; ++d) {
    const double weight = weights.emplace_back(std::exp(-0.5 * d * d / (sigma * sigma)));
    sum += weight, squares += weight * d * d, fourths += weight * d * d * d * d;
  }
  const double variance = squares / sum, spread = fourths / sum - variance * variance;
  std::vector<float> taps;
  for (int d = -reach; d <= reach; ++d) {
    const double factor = order == 0 ? 1.0 : order == 1 ? d / variance : 2.0 * (d * d - variance) / spread;
    taps.push_back(static_cast<float>(factor * weights[static_cast<std::size_t>(d + reach)] / sum));
  }
  return taps;
}

int mirrored(int at, int size) {
  const int period = 2 * size;
  at = (at % period + period) % period;
  return at < size ? at : period - 1 - at;
}

/// Whole rows at a time, so that the inner loop is over neighbours in memory.
void convolve(glm::ivec3 size, int axis, const std::vector<float>& taps, const std::vector<float>& from,
              std::vector<float>& to) {
  const int reach = static_cast<int>(taps.size()) / 2;
  const auto width = static_cast<std::size_t>(size.x);
  tbb::parallel_for(0, size.z, [&](int k) {
    std::vector<float> padded(width + 2 * static_cast<std::size_t>(reach));
    for (int j = 0; j < size.y; ++j) {
      float* const out = &to[indexIn(size, {0, j, k})];
      std::fill_n(out, width, 0.0F);
      if (axis == 0) {
        const float* const row = &from[indexIn(size, {0, j, k})];
        for (int i = -reach; i < size.x + reach; ++i)
          padded[static_cast<std::size_t>(i + reach)] = row[static_cast<std::size_t>(mirrored(i, size.x))];
      }
      for (int d = -reach; d <= reach; ++d) {
        const float tap = taps[static_cast<std::size_t>(d + reach)];
        glm::ivec3 source(0, j, k);
        if (axis != 0) source[axis] = mirrored(source[axis] + d, size[axis]);
        const float* const row =
            axis == 0 ? &padded[static_cast<std::size_t>(d + reach)] : &from[indexIn(size, source)];
        for (std::size_t i = 0; i < width; ++i) out[i] += tap * row[i];
      }
    }
  });
}

/// Of these orders along the axes.
std::vector<float> derivative(glm::ivec3 size, double sigma_cells, const std::vector<float>& values,
                              std::array<int, 3> orders) {
  std::vector<float> from = values, to(values.size());
  for (int axis = 0; axis < 3; ++axis) {
    convolve(size, axis, gaussianTaps(sigma_cells, orders[static_cast<std::size_t>(axis)]), from, to);
    std::swap(from, to);
  }
  return from;
}

}  // namespace

void smoothCells(glm::ivec3 size, double sigma_cells, std::vector<float>& values) {
  std::vector<float> other(values.size());
  const std::vector<float> taps = gaussianTaps(sigma_cells, 0);
  for (int axis = 0; axis < 3; ++axis) {
    convolve(size, axis, taps, values, other);
    std::swap(values, other);
  }
}

std::vector<float> gradientOfCells(glm::ivec3 size, double sigma_cells, const std::vector<float>& values) {
  std::vector<float> squares(values.size(), 0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<int, 3> orders{};
    orders[axis] = 1;
    const std::vector<float> slope = derivative(size, sigma_cells, values, orders);
    tbb::parallel_for(std::size_t{0}, squares.size(), [&](std::size_t n) { squares[n] += slope[n] * slope[n]; });
  }
  tbb::parallel_for(std::size_t{0}, squares.size(), [&](std::size_t n) { squares[n] = std::sqrt(squares[n]); });
  return squares;
}

std::vector<float> secondDerivative(glm::ivec3 size, double sigma_cells, const std::vector<float>& values, int axis,
                                    int other_axis) {
  std::array<int, 3> orders{};
  ++orders[static_cast<std::size_t>(axis)];
  ++orders[static_cast<std::size_t>(other_axis)];
  return derivative(size, sigma_cells, values, orders);
}

VolumeGrid meanGrid(const VolumeGrid& grid, int edge) {
  return {(grid.size + edge - 1) / edge, grid.spacing_mm * edge, grid.origin_P_mm + 0.5 * (edge - 1) * grid.spacing_mm};
}

std::vector<float> meansOfCubes(const VolumeGrid& grid, const std::vector<std::int16_t>& values, int edge) {
  const glm::ivec3 cells = meanGrid(grid, edge).size;
  std::vector<float> means(countIn(cells));
  tbb::parallel_for(0, cells.z, [&](int k) {
    forVoxels({0, 0, k}, {cells.x, cells.y, k + 1}, [&](glm::ivec3 cell) {
      const glm::ivec3 low = cell * edge, end = glm::min(low + edge, grid.size);
      int sum = 0;
      forVoxels(low, end, [&](glm::ivec3 ijk) { sum += values[grid.index(ijk)]; });
      means[indexIn(cells, cell)] = static_cast<float>(sum) / static_cast<float>(countIn(end - low));
    });
  });
  return means;
}

}  // namespace assets
