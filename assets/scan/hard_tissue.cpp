#include "assets/scan/hard_tissue.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr std::array<float, 5> kBinomial{1.0f, 4.0f, 6.0f, 4.0f, 1.0f};
constexpr float kSoftWeight = 0.02f;

/// Weighted hard tissue around a voxel: of one body, and in all.
struct HardSum {
  float body = 0.0f, all = 0.0f;
};

/// Weighted sums along one axis, air outside.
void smoothAlong(int axis, const VolumeGrid& grid, std::vector<HardSum>& sums) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3, length = grid.size[axis];
  glm::ivec3 step(0);
  step[axis] = 1;
  const std::size_t stride = grid.index(step);
  tbb::parallel_for(0, grid.size[v], [&](int b) {
    std::vector<HardSum> row(static_cast<std::size_t>(length) + 4);
    for (int a = 0; a < grid.size[u]; ++a) {
      glm::ivec3 start(0);
      start[u] = a;
      start[v] = b;
      HardSum* const first = &sums[grid.index(start)];
      for (std::size_t n = 0; n < static_cast<std::size_t>(length); ++n) row[n + 2] = first[n * stride];
      for (std::size_t n = 0; n < static_cast<std::size_t>(length); ++n) {
        HardSum sum;
        for (std::size_t tap = 0; tap < kBinomial.size(); ++tap) {
          sum.body += kBinomial[tap] * row[n + tap].body;
          sum.all += kBinomial[tap] * row[n + tap].all;
        }
        first[n * stride] = sum;
      }
    }
  });
}

}  // namespace

std::string_view nameOf(HardTissue tissue) { return tissue == HardTissue::bone ? "Bone" : "Teeth"; }

bool belongsTo(std::uint8_t label, HardTissue tissue) { return isTooth(label) == (tissue == HardTissue::tooth); }

std::vector<std::uint8_t> solidOf(HardTissue tissue, const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                  std::span<const std::uint8_t> label) {
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  if (label.empty())
    return tissue == HardTissue::bone ? std::vector(solid.begin(), solid.end())
                                      : std::vector<std::uint8_t>(solid.size());
  std::vector<HardSum> sums(solid.size());
  tbb::parallel_for(std::size_t{0}, solid.size(), [&](std::size_t n) {
    const float weight = static_cast<float>(solid[n]) * (isHard(label[n]) ? 1.0f : kSoftWeight);
    sums[n] = {belongsTo(label[n], tissue) ? weight : 0.0f, weight};
  });
  for (int axis = 0; axis < 3; ++axis) smoothAlong(axis, grid, sums);

  std::vector<std::uint8_t> field(solid.size());
  tbb::parallel_for(std::size_t{0}, solid.size(), [&](std::size_t n) {
    const float share = sums[n].all > 0.0f ? sums[n].body / sums[n].all : 0.0f;
    field[n] = std::min(solid[n], static_cast<std::uint8_t>(255.0f * share + 0.5f));
  });
  return field;
}

}  // namespace assets
