// The bone while it is carved: what is left of every voxel. One writer, the servo; everyone else copies dirty bricks.
// Frame P, mm, grid of the scan. `solid` 0..255 is the fraction of the voxel that is solid now; dose is how much of the
// voxel's first content has gone, 0..65535. 4 bytes a voxel (solid, first solid, dose).
// Constructing allocates; every other call is bounded and never allocates, locks or throws.
// Not the scan (assets::CtVolume, const): reset is a copy from it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/ct_volume.h"
#include "haptics/bone/dirty_bricks.h"

namespace haptics {

class CarvedBone {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty (all unlabelled). Copies both.
  CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label);

  const assets::VolumeGrid& grid() const { return grid_; }
  std::uint8_t label(std::size_t voxel) const { return label_[voxel]; }

  /// Writer's view: plain reads on the writing thread.
  std::span<const std::uint8_t> solid() const { return solid_; }

  /// Takes `fraction` (0..1) of the voxel's first content away. Writer only. Rounds the 16-bit dose up or down by a
  /// hash of (voxel, tick), so slow cutting loses nothing to rounding on average and a replay repeats it bit for bit.
  /// Returns the solid fraction removed, 0..1.
  double remove(std::size_t voxel, double fraction, std::uint64_t tick);

  /// Order-independent digest of every voxel's (solid, dose), kept up to date by remove(): equal bones, equal digests.
  std::uint64_t digest() const { return digest_; }

  DirtyBricks& dirtyBricks() { return dirty_; }

  /// Reader's side, any one thread: copies the 8x8x8 voxels of a brick (i fastest; outside the volume: 0).
  void copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const;

 private:
  assets::VolumeGrid grid_;
  std::vector<std::uint8_t> solid_, first_solid_, label_;
  std::vector<std::uint16_t> dose_;
  std::uint64_t digest_ = 0;
  DirtyBricks dirty_;
};

}  // namespace haptics
