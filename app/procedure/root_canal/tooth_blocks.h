// A tooth as it was before anything was cut, kept sparse: an index of 4 bytes a block, and the bytes of those blocks
// whose voxels differ. Made from a sampler; some 10 % of the blocks of a molar at 0.04 mm are kept. Frame P, mm.
// Immutable; any thread.
#pragma once

#include <array>
#include <vector>

#include "app/procedure/root_canal/fine_solid.h"
#include "assets/tooth_sampler.h"

namespace app {

class ToothBlocks final : public FineSolid {
 public:
  explicit ToothBlocks(const assets::ToothSampler& tooth);

  const assets::VolumeGrid& grid() const override { return grid_; }
  Block block(glm::ivec3 block) const override;
  /// assets::Tissue, in the same order.
  Block labels(glm::ivec3 block) const;
  std::uint8_t label(glm::ivec3 ijk) const {
    return grid_.contains(ijk) ? labels({ijk.x >> 2, ijk.y >> 2, ijk.z >> 2}).at(within(ijk)) : std::uint8_t{0};
  }

  std::size_t bytes() const { return 4 * index_.size() + 2 * kVoxels * solid_.size(); }

 private:
  using Bytes = std::array<std::uint8_t, kVoxels>;
  static constexpr std::uint32_t kKept = 1u << 31;  ///< else label and solid of all voxels

  std::uint32_t wordAt(glm::ivec3 block) const { return index_[assets::indexIn(blocks_, block)]; }

  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint32_t> index_;
  std::vector<Bytes> solid_, label_;
};

}  // namespace app
