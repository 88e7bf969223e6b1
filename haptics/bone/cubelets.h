// The solid fraction in memory: blocks of 4x4x4 voxels ("cubelets") with the sums of each block in arrays of their own.
// A block wholly inside a bur needs its sums alone (brick-moment theorem, reference/physics 5), so the cost of a sum
// grows with the bur's surface. Voxel and block indices; the volume is padded with air to whole blocks.
// Construction is O(voxels) and allocates; setBlock() takes about 50 ns; one writer. 2.2 bytes a voxel.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

/// Block (bx, by, bz) of (nx, ny, nz) has the number b = (bz ny + by) nx + bx; voxel (i, j, k) lies in block
/// (i >> 2, j >> 2, k >> 2) at v = (k & 3) 16 + (j & 3) 4 + (i & 3). Of block b:
///
///   array        element    offset   bytes  content
///   solid_       u8 [64]    64 b     64     w = 255 x solid fraction, in the order of v; one cache line
///   label_       u8 [64]    64 b     64     assets::Tissue, same order; the array is empty for an unlabelled volume
///   only_label_  u8         b        1      the label of all 64 voxels, kMixedLabels if they differ
///   weight_      u16        2 b      2      sum of w                       0 .. 16320
///   weight_x_    u16        2 b      2      sum of w (i & 3)               0 .. 24480
///   weight_y_    u16        2 b      2      sum of w (j & 3)
///   weight_z_    u16        2 b      2      sum of w (k & 3)
///   grey_        u32        4 b      4      sum of w (255 - w)             0 .. 1040384
///
///     solid_   | k = 0: j = 0 [i 0..3] j = 1 [i 0..3] j = 2 .. j = 3 | k = 1 .. | k = 2 .. | k = 3 .. | next block
///      byte      0             4              8                        16         32         48         64
class Cubelets {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans that do not fit the grid are a bug of the caller (assert).
  Cubelets(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);

  SolidField field() const;
  /// Replaces the solid bytes of a block and its sums. Writer only; stored relaxed.
  void setBlock(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& solid);

 private:
  void sumBlock(std::size_t block, const std::uint8_t* solid);

  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::vector<std::uint8_t> solid_, label_, only_label_;
  std::vector<std::uint16_t> weight_, weight_x_, weight_y_, weight_z_;
  std::vector<std::uint32_t> grey_;
};

}  // namespace haptics
