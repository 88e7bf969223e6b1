// The solid fraction in memory: blocks of 4x4x4 voxels ("cubelets") with the sums of each block in arrays of their own.
// A block wholly inside a bur needs its sums alone (brick-moment theorem, reference/physics 5), so the cost of a sum
// grows with the bur's surface. Voxel and block indices; the volume is padded with air to whole blocks.
// Dense: 2.2 bytes a voxel. Sparse: 4 bytes a block and 141 for each that is not one byte and one label throughout,
// and a reserve of slots for those that are cut later: nothing is allocated then.
// Construction is O(voxels) and allocates; setBlock() takes about 50 ns, own() 100; one writer.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

/// Every block in the slot of its number; or slots through an index, shared by blocks that are alike throughout.
enum class BlockStorage : std::uint8_t { dense, sparse };

/// Below it a grid is that of a single tooth (app/case/treated_tooth), mostly air and even tissue. Recordings of 0.05
/// mm were made with dense bone.
inline constexpr double kFineVoxel_mm = 0.045;
inline BlockStorage usualStorage(const assets::VolumeGrid& grid) {
  return grid.spacing_mm < kFineVoxel_mm ? BlockStorage::sparse : BlockStorage::dense;
}

/// Block (bx, by, bz) of (nx, ny, nz) has the number b = (bz ny + by) nx + bx; voxel (i, j, k) lies in block
/// (i >> 2, j >> 2, k >> 2) at v = (k & 3) 16 + (j & 3) 4 + (i & 3). Its slot is s = b, or s = slot_of_[b] if sparse.
/// Of slot s:
///
///   array        element    offset   bytes  content
///   solid_       u8 [64]    64 s     64     w = 255 x solid fraction, in the order of v; one cache line
///   label_       u8 [64]    64 s     64     assets::Tissue, same order; the array is empty for an unlabelled volume
///   only_label_  u8         s        1      the label of all 64 voxels, kMixedLabels if they differ
///   weight_      u16        2 s      2      sum of w                       0 .. 16320
///   weight_x_    u16        2 s      2      sum of w (i & 3)               0 .. 24480
///   weight_y_    u16        2 s      2      sum of w (j & 3)
///   weight_z_    u16        2 s      2      sum of w (k & 3)
///   grey_        u32        4 s      4      sum of w (255 - w)             0 .. 1040384
///
///     solid_   | k = 0: j = 0 [i 0..3] j = 1 [i 0..3] j = 2 .. j = 3 | k = 1 .. | k = 2 .. | k = 3 .. | next slot
///      byte      0             4              8                        16         32         48         64
///
///   sparse     | 0 .. shared_: one for each byte and label | own slots, near in space near in memory | reserve |
///                never written                                                          slots_used_ ^
class Cubelets {
 public:
  /// Of a sparse volume, for blocks that are alike throughout until they are cut; fewer where fewer are solid.
  static constexpr std::size_t kReserve = 16384;

  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans that do not fit the grid are a bug of the caller (assert).
  Cubelets(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
           BlockStorage storage = BlockStorage::dense);

  /// Sparse, labelled air, with `reserve` slots for what is put there.
  Cubelets(const assets::VolumeGrid& grid, std::size_t reserve);

  SolidField field() const;
  std::size_t blocks() const { return blocks_count_; }
  std::size_t slots() const { return weight_.size(); }
  /// Reserve not yet taken. Any thread.
  std::size_t slotsLeft() const { return slots() - __atomic_load_n(&slots_used_, __ATOMIC_RELAXED); }
  /// slotOf() as another thread than the writer may ask it.
  std::size_t slotSeen(std::size_t block) const {
    return slot_of_.empty() ? block : __atomic_load_n(slot_of_.data() + block, __ATOMIC_ACQUIRE);
  }
  std::size_t bytes() const;

  /// Whether the block has a slot that no other shares.
  bool isOwn(std::size_t block) const { return slot_of_.empty() || slot_of_[block] >= shared_; }
  /// Gives it one from the reserve where it has none; false: the reserve is used up. Writer only.
  bool own(std::size_t block);
  /// Replaces the solid bytes of a block and its sums. False, and nothing is changed: it has no slot of its own, there
  /// is none left, and it does not become what a shared one holds. Writer only; stored relaxed.
  bool setBlock(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& solid);
  /// Replaces the labels of a block that has a slot of its own. Writer only; stored relaxed.
  void setLabels(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& label);

 private:
  void fillDense(std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);
  void fillSparse(std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);
  void resize(std::size_t slots, bool is_labelled);
  void sumSlot(std::size_t slot, const std::uint8_t* solid);

  assets::VolumeGrid grid_;
  glm::ivec3 blocks_;
  std::size_t blocks_count_, slots_used_ = 0;
  std::uint32_t shared_ = 0;
  std::vector<std::uint32_t> slot_of_;
  std::vector<std::uint8_t> solid_, label_, only_label_;
  std::vector<std::uint16_t> weight_, weight_x_, weight_y_, weight_z_;
  std::vector<std::uint32_t> grey_;
};

}  // namespace haptics
