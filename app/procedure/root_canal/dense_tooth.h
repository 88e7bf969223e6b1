// A tooth's volume, voxel by voxel in the order of its grid, as blocks: for measures of a recorded session. The grid is
// of whole blocks. Frame P, mm. Any thread; the volumes must outlive a DenseTooth, a DenseSolid copies.
#pragma once

#include <span>
#include <vector>

#include "app/procedure/root_canal/fine_solid.h"
#include "assets/tooth_sampler.h"

namespace app {

class DenseTooth final : public assets::ToothSampler {
 public:
  DenseTooth(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label)
      : grid_(grid), solid_(solid), label_(label) {}

  const assets::VolumeGrid& grid() const override { return grid_; }
  std::optional<Same> same(glm::ivec3 low, int edge) const override {
    const std::size_t first = grid_.index(low);
    const Same one{solid_[first], label_[first]};
    bool is_same = true;
    // A cube of several blocks may reach beyond the grid.
    assets::forVoxels(low, glm::min(low + edge, grid_.size), [&](glm::ivec3 ijk) {
      const std::size_t v = grid_.index(ijk);
      is_same = is_same && solid_[v] == one.solid && label_[v] == one.label;
    });
    return is_same ? std::optional(one) : std::nullopt;
  }
  void block(glm::ivec3 block, std::span<std::uint8_t, kVoxels> solid,
             std::span<std::uint8_t, kVoxels> label) const override {
    std::size_t n = 0;
    assets::forVoxels(block * kEdge, (block + 1) * kEdge, [&](glm::ivec3 ijk) {
      const std::size_t v = grid_.index(ijk);
      solid[n] = solid_[v], label[n] = label_[v];
      ++n;
    });
  }

 private:
  assets::VolumeGrid grid_;
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
