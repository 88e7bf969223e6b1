// A tooth's volume, voxel by voxel in the order of its grid, as blocks: for measures of a recorded session. A grid that
// is not of whole blocks is grown with air by a DenseTooth. Frame P, mm. Any thread; the volumes must outlive a
// DenseTooth, a DenseSolid copies.
#pragma once

#include <span>
#include <vector>

#include "app/procedure/root_canal/fine_solid.h"
#include "assets/tooth_sampler.h"

namespace app {

class DenseTooth final : public assets::ToothSampler {
 public:
  DenseTooth(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label)
      : of_(grid), grid_(grid), solid_(solid), label_(label) {
    grid_.size = (grid.size + (kEdge - 1)) / kEdge * kEdge;
  }

  const assets::VolumeGrid& grid() const override { return grid_; }
  std::optional<Same> same(glm::ivec3 low, int edge) const override {
    const Same one = voxel(low);
    // A cube of several blocks may reach beyond the grid.
    const glm::ivec3 end = glm::min(low + edge, grid_.size);
    for (int k = low.z; k < end.z; ++k)
      for (int j = low.y; j < end.y; ++j)
        for (int i = low.x; i < end.x; ++i)
          if (const Same other = voxel({i, j, k}); other.solid != one.solid || other.label != one.label) return {};
    return one;
  }
  void block(glm::ivec3 block, std::span<std::uint8_t, kVoxels> solid,
             std::span<std::uint8_t, kVoxels> label) const override {
    std::size_t n = 0;
    assets::forVoxels(block * kEdge, (block + 1) * kEdge, [&](glm::ivec3 ijk) {
      const Same one = voxel(ijk);
      solid[n] = one.solid, label[n] = one.label;
      ++n;
    });
  }

 private:
  Same voxel(glm::ivec3 ijk) const {
    if (!of_.contains(ijk)) return {0, 0};
    const std::size_t v = of_.index(ijk);
    return {solid_[v], label_[v]};
  }

  assets::VolumeGrid of_, grid_;
  std::span<const std::uint8_t> solid_, label_;
};

class DenseSolid final : public FineSolid {
 public:
  DenseSolid(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid)
      : grid_(grid), blocks_(grid.size / kEdge), bytes_(grid.voxelCount()) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      bytes_[assets::indexIn(blocks_, ijk / kEdge) * kVoxels + within(ijk)] = solid[v];
    });
  }

  const assets::VolumeGrid& grid() const override { return grid_; }
  Block block(glm::ivec3 block) const override {
    return {bytes_.data() + assets::indexIn(blocks_, block) * kVoxels, 0};
  }

 private:
  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace app
