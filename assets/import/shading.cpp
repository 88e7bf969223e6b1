#include "assets/import/shading.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace assets {
namespace {

constexpr double kShadingCell_mm = 2.8, kSmoothing_mm = 14.0;
constexpr float kSoftLow_hu = -220.0F, kSoftHigh_hu = 260.0F, kSoftLevel_hu = 20.0F, kMostShading_hu = 300.0F;
constexpr double kLeastSoft = 0.02;
constexpr float kFullWeight = 0.03F;

/// Means of whole cells; the rest at the upper ends belongs to none.
std::vector<float> cellMeans(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield, int edge,
                             glm::ivec3 cells) {
  std::vector<float> means(countIn(cells));
  tbb::parallel_for(tbb::blocked_range<int>(0, cells.z), [&](const auto& range) {
    forVoxels({0, 0, range.begin()}, {cells.x, cells.y, range.end()}, [&](glm::ivec3 cell) {
      double sum = 0.0;
      forVoxels(cell * edge, (cell + 1) * edge, [&](glm::ivec3 ijk) { sum += hounsfield[grid.index(ijk)]; });
      means[indexIn(cells, cell)] = static_cast<float>(sum / std::pow(edge, 3));
    });
  });
  return means;
}

/// Cells of soft tissue with six such neighbours.
std::vector<float> softCells(const std::vector<float>& means, glm::ivec3 cells) {
  const auto is_soft = [&](glm::ivec3 cell) {
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, cells))) return false;
    const float mean = means[indexIn(cells, cell)];
    return mean > kSoftLow_hu && mean < kSoftHigh_hu;
  };
  std::vector<float> soft(means.size());
  forVoxels(glm::ivec3(0), cells, [&](glm::ivec3 cell) {
    bool is_inner = is_soft(cell);
    for (int axis = 0; axis < 3 && is_inner; ++axis) {
      glm::ivec3 step(0);
      step[axis] = 1;
      is_inner = is_soft(cell - step) && is_soft(cell + step);
    }
    soft[indexIn(cells, cell)] = is_inner ? 1.0F : 0.0F;
  });
  return soft;
}

/// Gaussian along all axes, mirrored at the ends.
void smooth(std::vector<float>& values, glm::ivec3 cells, double sigma_cells) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma_cells));
  std::vector<float> weights(static_cast<std::size_t>(reach) + 1);
  float sum = 0.0F;
  for (int d = 0; d <= reach; ++d) {
    weights[static_cast<std::size_t>(d)] = static_cast<float>(std::exp(-0.5 * d * d / (sigma_cells * sigma_cells)));
    sum += (d == 0 ? 1.0F : 2.0F) * weights[static_cast<std::size_t>(d)];
  }
  for (float& weight : weights) weight /= sum;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float> before = values;
    const int size = cells[axis];
    tbb::parallel_for(tbb::blocked_range<int>(0, cells.z), [&](const auto& range) {
      forVoxels({0, 0, range.begin()}, {cells.x, cells.y, range.end()}, [&](glm::ivec3 cell) {
        float total = 0.0F;
        for (int d = -reach; d <= reach; ++d) {
          int at = cell[axis] + d;
          const int period = 2 * size;
          at = (at % period + period) % period;
          at = at < size ? at : period - 1 - at;
          glm::ivec3 from = cell;
          from[axis] = at;
          total += weights[static_cast<std::size_t>(std::abs(d))] * before[indexIn(cells, from)];
        }
        values[indexIn(cells, cell)] = total;
      });
    });
  }
}

float medianOf(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Cells on both sides of a voxel along one axis.
struct Between {
  int below = 0, above = 0;
  float share = 0.0F;
};
Between between(int voxel, int edge, int cells) {
  const double at = std::clamp((voxel + 0.5) / edge - 0.5, 0.0, cells - 1.0);
  const int below = std::min(static_cast<int>(at), std::max(cells - 2, 0));
  return {below, std::min(below + 1, cells - 1), static_cast<float>(at - below)};
}

/// Values of the cells for one row of voxels, between the four rows of cells round it.
void rowBetween(const std::vector<float>& values, glm::ivec3 cells, const Between& y, const Between& z,
                std::vector<float>& row) {
  for (int x = 0; x < cells.x; ++x) {
    const auto along_y = [&](int layer) {
      return (1.0F - y.share) * values[indexIn(cells, {x, y.below, layer})] +
             y.share * values[indexIn(cells, {x, y.above, layer})];
    };
    row[static_cast<std::size_t>(x)] = (1.0F - z.share) * along_y(z.below) + z.share * along_y(z.above);
  }
}

}  // namespace

double flattenShading(const VolumeGrid& grid, std::vector<std::int16_t>& hounsfield) {
  const int edge = std::max(1, static_cast<int>(std::lround(kShadingCell_mm / grid.spacing_mm)));
  const glm::ivec3 cells = grid.size / edge;
  if (glm::any(glm::lessThan(cells, glm::ivec3(3)))) return 0.0;
  const std::vector<float> means = cellMeans(grid, hounsfield, edge, cells);
  std::vector<float> weight = softCells(means, cells);
  std::vector<float> soft_values;
  for (std::size_t n = 0; n < means.size(); ++n)
    if (weight[n] > 0.0F) soft_values.push_back(means[n]);
  if (static_cast<double>(soft_values.size()) < kLeastSoft * static_cast<double>(means.size())) return 0.0;
  const float median = medianOf(soft_values);
  std::vector<float> shading(means.size());
  for (std::size_t n = 0; n < means.size(); ++n) shading[n] = weight[n] * (means[n] - median);
  const double sigma_cells = kSmoothing_mm / (edge * grid.spacing_mm);
  smooth(weight, cells, sigma_cells);
  smooth(shading, cells, sigma_cells);
  double sum = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < shading.size(); ++n) {
    const float local = std::clamp(shading[n] / std::max(weight[n], 1.0e-3F), -kMostShading_hu, kMostShading_hu);
    shading[n] = local * std::clamp(weight[n] / kFullWeight, 0.0F, 1.0F) + (median - kSoftLevel_hu);
    sum += static_cast<double>(shading[n]), squares += static_cast<double>(shading[n] * shading[n]);
  }
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size.z), [&](const auto& range) {
    std::vector<float> row(static_cast<std::size_t>(cells.x));
    for (int k = range.begin(); k < range.end(); ++k)
      for (int j = 0; j < grid.size.y; ++j) {
        rowBetween(shading, cells, between(j, edge, cells.y), between(k, edge, cells.z), row);
        std::int16_t* values = hounsfield.data() + grid.index({0, j, k});
        for (int i = 0; i < grid.size.x; ++i) {
          const Between x = between(i, edge, cells.x);
          const float local = (1.0F - x.share) * row[static_cast<std::size_t>(x.below)] +
                              x.share * row[static_cast<std::size_t>(x.above)];
          const float flat = std::clamp(static_cast<float>(values[i]) - local, -32767.0F, 32767.0F);
          values[i] = static_cast<std::int16_t>(std::floor(flat + 0.5F));
        }
      }
  });
  const double count = static_cast<double>(shading.size());
  return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

}  // namespace assets
