// The bone while it is carved: what is left of every voxel. One writer, the servo; everyone else copies dirty bricks.
// Frame P, mm, grid of the scan. `solid` 0..255 is the fraction of the voxel that is solid now. What a bur has done to
// a block of voxels is kept from its first cut on: `first`, what it held; `dose` 0..65535, how much of that has gone;
// `reach` 0..255, the largest part of it a bur has covered so far.
// Memory: 2.3 bytes a voxel and 4 more for every voxel of a block that was cut; room for that is set aside for 42 % of
// the blocks, so it never exceeds 4 bytes a voxel. In blocks cut beyond that the surface is the nearest voxel's: only
// voxels covered by half or more lose, at the same rate.
// Constructing allocates; every other call is bounded and never allocates, locks or throws.
// Not the scan (assets::CtVolume, const): reset is a copy from it. Not the shape of a cut (bone/carve).
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

/// What one step takes from the 64 voxels of a block. Units of 1/65535 of a voxel.
struct BlockCut {
  std::array<std::uint16_t, kBlockVoxels> coverage{};          ///< how much of it the bur covers
  std::array<std::uint32_t, kBlockVoxels> exposure{};          ///< coverage, times how hard the bur cuts just there
  std::array<std::uint32_t, assets::kTissueCount> loss_q32{};  ///< part of the exposure that goes, in 2^-32
  std::uint64_t tick = 0;                                      ///< steers rounding
};

/// All that cutting changes of a block: what is left, how far it was reached, how much of it has gone.
struct BlockState {
  std::array<std::uint8_t, kBlockVoxels> solid{}, reach{};
  std::array<std::uint16_t, kBlockVoxels> dose{};

  bool operator==(const BlockState&) const = default;
};

class CarvedBone {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans that do not fit the grid are a bug of the caller (assert).
  CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);

  const assets::VolumeGrid& grid() const { return grid_; }
  SolidField field() const { return cubelets_.field(); }

  /// Takes from a block what `cut` says. Of a voxel with dose D, covered by the fraction g:
  /// D <- min(D + exposure loss, max g so far), of what it held at first: a bur that stays for ever takes its own
  /// volume and no more. The dose rounds by a low-discrepancy sequence over `tick`, the solid fraction by a fixed
  /// threshold per voxel: slow cutting loses nothing to rounding, and a replay repeats it bit for bit. Adds the solid
  /// steps of 1/255 removed to `steps`, by tissue; true if there were any. Marks the brick. Saves the block to
  /// `strokes` first, if there is one and it has to. Writer only.
  bool cutBlock(glm::ivec3 block, const BlockCut& cut, std::array<std::int64_t, assets::kTissueCount>& steps,
                StrokeHistory* strokes = nullptr);

  /// Of the block at that place of SolidField::blockAt.
  BlockState stateOf(std::size_t block) const;
  /// Makes the block what it was, sums, digest and removed volume too; the solid steps of 1/255 that came back. Marks
  /// the brick. A state that is not one of this block's past is a bug of the caller. Writer only.
  std::int64_t restoreBlock(std::size_t block, const BlockState& state);

  /// Order-independent digest of every voxel's (solid, reach, dose), kept up to date: equal bones, equal digests.
  std::uint64_t digest() const { return digest_; }

  DirtyBricks& dirtyBricks() { return dirty_; }

  /// What is gone since construction, by assets::Tissue; a label that is none counts as 0. Writing thread, or while
  /// nobody writes.
  std::array<double, assets::kTissueCount> removedByTissue_mm3() const noexcept;

  /// The solid fraction in the order of the grid. O(voxels), allocates; for the writing thread or while nobody writes.
  std::vector<std::uint8_t> solidInGridOrder() const;

  /// Reader's side, any one thread: copies the 8x8x8 voxels of a brick (i fastest; outside the volume: 0).
  void copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const;

  /// All that this holds, and the blocks that may still be cut with full precision.
  std::size_t bytes() const;
  std::size_t blocksLeft() const { return histories_most_ - histories_used_; }

 private:
  struct History {
    std::array<std::uint8_t, kBlockVoxels> first, reach;
    std::array<std::uint16_t, kBlockVoxels> dose;
  };
  History* historyOf(std::size_t block);
  void addToDigest(std::uint64_t block_key, const BlockDigest& change);

  assets::VolumeGrid grid_;
  Cubelets cubelets_;
  std::vector<std::uint32_t> history_of_;  ///< by block: its place in histories_ plus 1, 0: none yet
  std::size_t histories_most_ = 0, histories_used_ = 0;
  std::vector<History> histories_;
  std::array<std::int64_t, assets::kTissueCount> removed_steps_{};
  std::uint64_t digest_ = 0;
  DirtyBricks dirty_;
};

}  // namespace haptics
