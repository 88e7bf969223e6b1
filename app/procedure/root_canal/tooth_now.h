// A tooth as it is: the blocks that have changed over those it had before, so that it costs memory and time for what
// was cut alone. Frame P, mm. One writer; any thread reads it meanwhile not written. Nanoseconds a block.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/root_canal/tooth_blocks.h"

namespace app {

class ToothNow final : public FineSolid {
 public:
  using Bytes = std::array<std::uint8_t, kVoxels>;

  /// Borrows what it was.
  explicit ToothNow(const ToothBlocks& before);

  const assets::VolumeGrid& grid() const override { return before_.grid(); }
  Block block(glm::ivec3 block) const override;

  /// Its place in told(); none: nothing is new, or there is no such block.
  std::optional<std::size_t> set(glm::ivec3 block, const Bytes& bytes);
  /// Blocks that were ever set(), in that order.
  std::span<const glm::ivec3> told() const { return told_; }

 private:
  const ToothBlocks& before_;
  glm::ivec3 blocks_;
  std::vector<std::uint32_t> index_;  ///< 0: as before; else 1 + its place in `bytes_`
  std::vector<Bytes> bytes_;
  std::vector<glm::ivec3> told_;
};

}  // namespace app
