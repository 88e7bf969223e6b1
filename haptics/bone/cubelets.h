// How the solid fraction lies in memory: blocks of 4x4x4 voxels, 64 bytes, one cache line each ("cubelets"), with the
// sums of each block beside them. A bur that covers a block whole needs its sums alone (brick-moment theorem,
// reference/physics 5): cost falls from the bur's volume to its surface. Voxel and block indices; the volume is filled
// up with air to whole blocks. Building is O(voxels) and allocates; setBlock() is bounded, some 50 ns, one writer.
// 2.2 bytes a voxel. Not what has been cut (bone/carved_bone).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

class Cubelets {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans that do not fit the grid are a bug of the caller (assert).
  Cubelets(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);

  SolidField field() const;
  /// Gives a block new solid bytes. Writer only; stored relaxed.
  void setBlock(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& solid);

 private:
  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint8_t> solid_, label_, only_label_;
  std::vector<std::uint16_t> weight_, weight_x_, weight_y_, weight_z_;
  std::vector<std::uint32_t> grey_;
};

}  // namespace haptics
