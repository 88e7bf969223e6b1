// What was laid into a tooth as measures read it: the filling's part of each voxel, sparse, brought up to date block by
// block. Frame P. One writer; any thread reads it meanwhile not written. Nanoseconds a block.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "app/procedure/root_canal/fine_solid.h"

namespace app {

class LaidBlocks final : public FineSolid {
 public:
  using Bytes = std::array<std::uint8_t, kVoxels>;

  /// Of whole blocks.
  explicit LaidBlocks(const assets::VolumeGrid& grid)
      : grid_(grid), blocks_(grid.size / kEdge), index_(assets::countIn(blocks_)) {}

  const assets::VolumeGrid& grid() const override { return grid_; }
  Block block(glm::ivec3 block) const override {
    const std::uint32_t place = index_[assets::indexIn(blocks_, block)];
    return place == 0 ? Block{} : Block{bytes_[place - 1].data(), 0};
  }
  bool isEmpty() const { return bytes_.empty(); }

  /// False: nothing is new, or there is no such block.
  bool set(glm::ivec3 block, const Bytes& bytes) {
    if (glm::any(glm::lessThan(block, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(block, blocks_))) return false;
    std::uint32_t& place = index_[assets::indexIn(blocks_, block)];
    if (place == 0) {
      if (std::ranges::all_of(bytes, [](std::uint8_t one) { return one == 0; })) return false;
      bytes_.push_back(bytes);
      place = static_cast<std::uint32_t>(bytes_.size());
      return true;
    }
    if (bytes_[place - 1] == bytes) return false;
    bytes_[place - 1] = bytes;
    return true;
  }

 private:
  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint32_t> index_;  ///< 0: nothing; else 1 + its place in `bytes_`
  std::vector<Bytes> bytes_;
};

}  // namespace app
