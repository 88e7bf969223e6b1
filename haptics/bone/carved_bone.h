// The bone while it is carved: what is left of every voxel. One writer, the servo; everyone else copies dirty bricks.
// Frame P, mm, grid of the scan. `solid` 0..255 is the fraction of the voxel that is solid now; `dose` 0..65535 is how
// much of its first content has gone; `reach` 0..255 is the largest part of it a bur has covered so far.
// 6 bytes a voxel (solid, first solid, label, reach, dose).
// Constructing allocates; every other call is bounded and never allocates, locks or throws.
// Not the scan (assets::CtVolume, const): reset is a copy from it. Not the cutting itself (bone/carve).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/bone/dirty_bricks.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

class CarvedBone {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  /// Spans that do not fit the grid are a bug of the caller (assert).
  CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);

  const assets::VolumeGrid& grid() const { return grid_; }
  std::uint8_t label(std::size_t voxel) const { return label_.empty() ? std::uint8_t{0} : label_[voxel]; }

  /// Writer's view: plain reads on the writing thread.
  std::span<const std::uint8_t> solid() const { return solid_; }
  SolidField field() const { return {grid_, solid_, label_}; }

  /// Takes `loss` (0..1) of the voxel's first content away, but never more of it in total than the largest `coverage`
  /// (0..1) a bur ever had of it: a bur that stays for ever takes its own volume and no more. Writer only.
  /// The dose rounds up or down by a low-discrepancy sequence over `tick`, the solid fraction by a fixed threshold per
  /// voxel: slow cutting loses nothing to rounding, and a replay repeats it bit for bit.
  /// Returns the solid steps removed, 0..255. The caller marks the brick in dirtyBricks() when it is done with it.
  int remove(std::size_t voxel, double coverage, double loss, std::uint64_t tick);

  /// Order-independent digest of every voxel's (solid, reach, dose), kept up to date by remove(): equal bones, equal
  /// digests.
  std::uint64_t digest() const { return digest_; }

  DirtyBricks& dirtyBricks() { return dirty_; }

  /// What is gone since construction, by assets::Tissue; a label that is none counts as 0. O(voxels), for the writing
  /// thread or while nobody writes; not for the servo's tick.
  std::array<double, assets::kTissueCount> removedByTissue_mm3() const;

  /// Reader's side, any one thread: copies the 8x8x8 voxels of a brick (i fastest; outside the volume: 0).
  void copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const;

 private:
  assets::VolumeGrid grid_;
  std::vector<std::uint8_t> solid_, first_solid_, label_, reach_;
  std::vector<std::uint16_t> dose_;
  std::uint64_t digest_ = 0;
  DirtyBricks dirty_;
};

}  // namespace haptics
