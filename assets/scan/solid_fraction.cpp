#include "assets/scan/solid_fraction.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "assets/load_error.h"

namespace assets {

namespace {

constexpr int kGreyValues = 65536;
constexpr int kLowestHu = -32768;

void requireWidth(const Classification& classification) {
  if (!std::isfinite(classification.iso_hu) || !std::isfinite(classification.sigma_hu) ||
      classification.sigma_hu <= 0.0)
    throw LoadError("classification: iso and sigma must be finite and sigma above 0 HU; give --iso and --sigma");
}

std::uint8_t solidAt(double sigmas_above_iso) {
  if (sigmas_above_iso <= -3.0) return 0;  // 255 Phi(-3) = 0.34
  if (sigmas_above_iso >= 3.0) return 255;
  const double fraction = 0.5 * std::erfc(-sigmas_above_iso / std::numbers::sqrt2);
  return static_cast<std::uint8_t>(std::lround(255.0 * fraction));
}

/// Solid fraction of every int16 value.
std::vector<std::uint8_t> tableOf(const Classification& classification) {
  std::vector<std::uint8_t> table(kGreyValues);
  for (int i = 0; i < kGreyValues; ++i)
    table[static_cast<std::size_t>(i)] = solidAt((i + kLowestHu - classification.iso_hu) / classification.sigma_hu);
  return table;
}

/// HU difference per voxel along one axis: central inside, one-sided at the faces of the volume.
double risePerVoxel(const std::int16_t* at, int i, int size, std::ptrdiff_t stride) {
  const int below = i > 0 ? 1 : 0;
  const int above = i + 1 < size ? 1 : 0;
  if (below + above == 0) return 0.0;
  return static_cast<double>(at[above * stride] - at[-below * stride]) / (below + above);
}

}  // namespace

std::vector<std::uint8_t> solidFromHounsfield(const std::vector<std::int16_t>& hounsfield,
                                              const Classification& classification) {
  requireWidth(classification);
  const std::vector<std::uint8_t> table = tableOf(classification);
  std::vector<std::uint8_t> solid(hounsfield.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, solid.size(), 1 << 16), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v)
      solid[v] = table[static_cast<std::size_t>(hounsfield[v] - kLowestHu)];
  });
  return solid;
}

std::vector<std::uint8_t> classify(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                   const Classification& classification) {
  requireWidth(classification);
  assert(hounsfield.size() == grid.voxelCount());
  const std::vector<std::uint8_t> table = tableOf(classification);
  std::vector<std::uint8_t> solid(hounsfield.size());
  const std::ptrdiff_t row = grid.size.x;
  const std::ptrdiff_t slice = row * grid.size.y;

  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size.z), [&](const auto& slices) {
    for (int k = slices.begin(); k != slices.end(); ++k) {
      for (int j = 0; j < grid.size.y; ++j) {
        const std::size_t first = grid.index({0, j, k});
        for (int i = 0; i < grid.size.x; ++i) {
          const std::size_t v = first + static_cast<std::size_t>(i);
          const std::int16_t* at = hounsfield.data() + v;

          // A slope of G per voxel gives Phi a slope of G / (sigma sqrt(2 pi)) per voxel: at most 1.
          const double gi = risePerVoxel(at, i, grid.size.x, 1);
          const double gj = risePerVoxel(at, j, grid.size.y, row);
          const double gk = risePerVoxel(at, k, grid.size.z, slice);
          const double square = (gi * gi + gj * gj + gk * gk) / (2.0 * std::numbers::pi);
          const bool wide_enough = square <= classification.sigma_hu * classification.sigma_hu;
          solid[v] = wide_enough ? table[static_cast<std::size_t>(*at - kLowestHu)]
                                 : solidAt((*at - classification.iso_hu) / std::sqrt(square));
        }
      }
    }
  });
  return solid;
}

}  // namespace assets
