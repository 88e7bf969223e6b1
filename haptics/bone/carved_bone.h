// The bone while it is carved: the solid fraction of every voxel and the history of every block that was cut. Frame P,
// mm, grid of the scan. One writer, the servo; other threads copy dirty bricks.
// Construction allocates; every other call is bounded and never allocates, locks or throws. Dense: at most 4 bytes a
// voxel; sparse: bone/cubelets. In blocks cut after the histories are used up only voxels covered by half or more lose,
// at the same rate; of a sparse bone whose slots are used up only whole blocks covered by half or more, at the same
// rate. Reset is a copy of the scan (assets::CtVolume). Shape of a cut: bone/carve.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/tissue.h"
#include "haptics/bone/cubelets.h"
#include "haptics/bone/dirty_bricks.h"

namespace haptics {

struct BlockDigest;
class StrokeHistory;

/// What one step removes from the 64 voxels of a block. Units of 1/65535 of a voxel.
struct BlockCut {
  std::array<std::uint16_t, kBlockVoxels> coverage{};          ///< part of the voxel the bur covers
  std::array<std::uint32_t, kBlockVoxels> exposure{};          ///< coverage times relative cutting speed there
  std::array<std::uint32_t, assets::kTissueCount> loss_q32{};  ///< part of the exposure removed, in 2^-32
  std::uint64_t tick = 0;                                      ///< seed of the rounding
};

/// All that cutting changes in a block. 256 bytes.
struct BlockState {
  std::array<std::uint8_t, kBlockVoxels> solid{}, reach{};
  std::array<std::uint16_t, kBlockVoxels> dose{};

  bool operator==(const BlockState&) const = default;
};
static_assert(sizeof(BlockState) == 256);

/// Memory layout, next to the arrays of bone/cubelets; b = block number (SolidField::blockAt), s = its slot, v = voxel
/// within:
///
///   history_of_  u32 per slot, at 4 s: 0 = never cut, else 1 + index h into histories_
///   histories_   256 bytes per cut block, at 256 h; capacity min(blocks with bone, max(42 % of blocks, 16384)), sparse
///                min(slots, 16384):
///
///     offset  0 ............ 63 | 64 ........... 127 | 128 .................... 255
///             first  u8 [64]    | reach  u8 [64]     | dose  u16 [64]
///             solid before the  | largest coverage   | part of `first` removed,
///             first cut         | so far, 0..255     | 0..65535
///
///   solid_steps_ i64: sum of all solid bytes
///   digest_      u64: low and high 32 bits are sums modulo 2^32 over all blocks with bone,
///                (half of mixedBits(b + 1) | 1) x sum over v of weight(v) x (solid << 24 | reach << 16 | dose),
///                so a cut updates it by the difference of one block and order does not matter
///   dirty_       one bit per brick of 8x8x8 voxels (2x2x2 blocks)
///   written_     one bit per block, at bit b % 64 of word b / 64: state changed, though it may be no solid
class CarvedBone {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans must fit the grid (assert).
  CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label)
      : CarvedBone(grid, solid, label, usualStorage(grid)) {}
  CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
             BlockStorage storage);

  /// Dense, with nothing left, as if all had been cut away: what is left of the other can be moved to it.
  static CarvedBone emptied(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                            std::span<const std::uint8_t> label);

  const assets::VolumeGrid& grid() const { return grid_; }
  bool isEmpty() const { return solid_steps_ == 0; }
  std::size_t blocks() const { return cubelets_.blocks(); }
  /// The number of block 0 in a StrokeHistory of several bones. Before the first cut.
  void setFirstBlock(std::size_t number) { first_block_ = number; }
  SolidField field() const { return cubelets_.field(); }

  /// Cuts a block. A voxel with dose D, covered by the fraction g: D <- min(D + exposure loss, max g so far), of its
  /// first content, so a dwelling bur removes its own volume and no more. The dose rounds by a low-discrepancy sequence
  /// over `tick`, the solid fraction by a fixed threshold per voxel: slow cutting loses nothing to rounding. Adds the
  /// solid steps of 1/255 removed to `steps`, by tissue; true if there were any. Marks the brick. Saves the block to
  /// `strokes` first where needed. Writer only.
  bool cutBlock(glm::ivec3 block, const BlockCut& cut, std::array<std::int64_t, assets::kTissueCount>& steps,
                StrokeHistory* strokes = nullptr);

  /// Moves up to `given` of each voxel of a block to the same block of `to`, made by emptied(), with its history: both
  /// are cut on as the whole would have been. No solid is lost or made. Marks the bricks. Saves both blocks to
  /// `strokes` first where needed. Writer only.
  void moveBlock(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given, CarvedBone& to,
                 StrokeHistory* strokes = nullptr);

  /// Takes up to `given` of each voxel of a block away, as if it had been cut. Returns the solid steps of 1/255 taken.
  /// Marks the brick. Saves the block to `strokes` first where needed. Writer only.
  std::int64_t loseBlock(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given,
                         StrokeHistory* strokes = nullptr);

  BlockState stateOf(std::size_t block) const;
  /// Restores an earlier state of this block with its sums, digest and removed volume. Returns the solid steps of 1/255
  /// restored. Marks the brick. Writer only.
  std::int64_t restoreBlock(std::size_t block, const BlockState& state);

  /// Order-independent digest of every voxel's (solid, reach, dose).
  std::uint64_t digest() const { return digest_; }

  DirtyBricks& dirtyBricks() { return dirty_; }
  /// Appends the blocks of which solid, reach or dose may have changed since the last call. Allocates; writing thread,
  /// not in a step.
  void takeWritten(std::vector<std::size_t>& out);

  /// Volume removed since construction, by assets::Tissue; unknown labels count as 0. Writing thread, or without a
  /// writer.
  std::array<double, assets::kTissueCount> removedByTissue_mm3() const noexcept;

  /// The solid fraction in the order of the grid. O(voxels), allocates; writing thread, or without a writer.
  std::vector<std::uint8_t> solidInGridOrder() const;

  /// The labels in the order of the grid; empty: unlabelled. They never change. O(voxels), allocates; any thread.
  std::vector<std::uint8_t> labelInGridOrder() const;

  /// Copies the 8x8x8 voxels of a brick (i fastest; outside the volume: 0). One reading thread.
  void copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const;

  /// The voxels of a box from the first of a brick on, in grid order; outside the volume: 0. Brick by brick, so a cut
  /// may fall between two. Allocates; one reading thread.
  std::vector<std::uint8_t> copyBox(glm::ivec3 first_brick, glm::ivec3 size) const;

  /// Memory used, and the number of histories left.
  std::size_t bytes() const;
  std::size_t blocksLeft() const { return histories_most_ - histories_used_; }
  /// Of a sparse bone, for even blocks that are cut; and whether there were none left for one, so that it was cut
  /// whole. Any thread.
  std::size_t slotsLeft() const { return cubelets_.slotsLeft(); }
  bool cutsWholeBlocks() const { return __atomic_load_n(&cuts_whole_, __ATOMIC_RELAXED); }
  /// Distinct by slotOf().
  std::size_t slots() const { return cubelets_.slots(); }

 private:
  struct History {
    std::array<std::uint8_t, kBlockVoxels> first, reach;
    std::array<std::uint16_t, kBlockVoxels> dose;
  };
  /// Of a block with a slot of its own.
  History* historyOf(std::size_t block);
  bool cutWhole(glm::ivec3 block_ijk, const BlockCut& cut, std::array<std::int64_t, assets::kTissueCount>& steps,
                StrokeHistory* strokes);
  bool meetsGiven(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given) const;
  void markWritten(std::size_t block) { written_[block / 64] |= std::uint64_t{1} << block % 64; }
  void saveTo(StrokeHistory* strokes, std::size_t block) const;
  void addToDigest(std::uint64_t block_key, const BlockDigest& change);

  assets::VolumeGrid grid_;
  Cubelets cubelets_;
  std::vector<std::uint32_t> history_of_;
  std::size_t first_block_ = 0;  ///< its number in a StrokeHistory
  std::size_t histories_most_ = 0, histories_used_ = 0;
  std::vector<History> histories_;
  std::array<std::int64_t, assets::kTissueCount> removed_steps_{};
  std::int64_t solid_steps_ = 0;
  std::uint64_t digest_ = 0;
  bool cuts_whole_ = false;
  DirtyBricks dirty_;
  std::vector<std::uint64_t> written_;
};

}  // namespace haptics
