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

/// Hard matter around a place: of the body asked for, and of all.
struct Matter {
  float body = 0.0f, all = 0.0f;
};

/// Sums along one axis, air outside. Rows of that axis are independent of one another.
void gatherAlong(int axis, const VolumeGrid& grid, std::vector<Matter>& matter) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3, length = grid.size[axis];
  glm::ivec3 step(0);
  step[axis] = 1;
  const std::size_t stride = grid.index(step);
  tbb::parallel_for(0, grid.size[v], [&](int b) {
    std::vector<Matter> row(static_cast<std::size_t>(length) + 4);
    for (int a = 0; a < grid.size[u]; ++a) {
      glm::ivec3 start(0);
      start[u] = a;
      start[v] = b;
      Matter* const first = &matter[grid.index(start)];
      for (std::size_t n = 0; n < static_cast<std::size_t>(length); ++n) row[n + 2] = first[n * stride];
      for (std::size_t n = 0; n < static_cast<std::size_t>(length); ++n) {
        Matter sum;
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

bool belongsTo(std::uint8_t label, HardTissue tissue) {
  switch (static_cast<Tissue>(label)) {
    case Tissue::other_teeth:
    case Tissue::enamel:
    case Tissue::dentine:
    case Tissue::pulp:
      return tissue == HardTissue::tooth;
    default:
      return tissue == HardTissue::bone;
  }
}

std::vector<std::uint8_t> solidOf(HardTissue tissue, const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                  std::span<const std::uint8_t> label) {
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  if (label.empty())
    return tissue == HardTissue::bone ? std::vector(solid.begin(), solid.end())
                                      : std::vector<std::uint8_t>(solid.size());
  std::vector<Matter> matter(solid.size());
  tbb::parallel_for(std::size_t{0}, solid.size(), [&](std::size_t n) {
    const float weight = static_cast<float>(solid[n]) * (isHard(label[n]) ? 1.0f : kSoftWeight);
    matter[n] = {belongsTo(label[n], tissue) ? weight : 0.0f, weight};
  });
  for (int axis = 0; axis < 3; ++axis) gatherAlong(axis, grid, matter);

  std::vector<std::uint8_t> field(solid.size());
  tbb::parallel_for(std::size_t{0}, solid.size(), [&](std::size_t n) {
    const float share = matter[n].all > 0.0f ? matter[n].body / matter[n].all : 0.0f;
    field[n] = std::min(solid[n], static_cast<std::uint8_t>(255.0f * share + 0.5f));
  });
  return field;
}

}  // namespace assets
