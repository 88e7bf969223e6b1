// What a dentist has laid into a tooth: how much of each voxel of the tooth's grid is filling, of which material
// (assets::Tissue), in which increment, and how long light has reached it. A body beside the tooth: their solid
// fractions add up, so that force, cutting and picture need no case of their own. One writer, the servo; other threads
// copy dirty bricks. Frame P, mm. Sparse: 8 bytes a block and 416 for each of the kMostBlocks that can be filled; where
// they are used up nothing more is laid. Construction allocates; every other call is bounded and never allocates, locks
// or throws. What instruments do to it: bone/lay.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/bone/carved_bone.h"

namespace haptics {

/// Not set: it can be pressed aside.
constexpr bool isPlastic(std::uint8_t label) {
  return label >= static_cast<std::uint8_t>(assets::Tissue::composite_soft) &&
         label != static_cast<std::uint8_t>(assets::Tissue::composite) &&
         label != static_cast<std::uint8_t>(assets::Tissue::glass_ionomer);
}

/// A grid on which a tooth is filled: that of a single tooth.
inline bool isFillable(const assets::VolumeGrid& grid) { return grid.spacing_mm < 0.085; }

/// The filling's part of each voxel, its assets::Tissue, its increment.
struct FillingBrick {
  std::array<std::uint8_t, 512> laid{}, tissue{}, increment{};
};

/// A block as undo and digest know it (BlockState): `solid` is the filling's part of each voxel, `reach` its material's
/// assets::Tissue, `dose` 2^10 times its increment plus its light in units of kLightUnit_s. All 0 where there is none.
class Filling {
 public:
  static constexpr std::size_t kMostBlocks = 16384;
  static constexpr unsigned kIncrementShift = 10, kMostIncrements = 63, kMostLight = 1023;
  static constexpr double kLightUnit_s = 0.02;

  explicit Filling(const assets::VolumeGrid& grid);

  const assets::VolumeGrid& grid() const { return grid_; }
  bool isEmpty() const { return steps_ == 0; }
  std::size_t blocks() const { return cubelets_.blocks(); }
  std::size_t blocksLeft() const { return cubelets_.slotsLeft(); }
  SolidField field() const { return cubelets_.field(); }
  /// Of what has set alone.
  SolidField setField() const { return set_.field(); }
  bool hasSet() const { return set_steps_ != 0; }
  /// The number of block 0 in a StrokeHistory.
  void setFirstBlock(std::size_t number) { first_block_ = number; }

  BlockState stateOf(std::size_t block) const;
  /// An earlier state of this block, with its sums and digest. Marks the brick. Writer only.
  void restoreBlock(std::size_t block, const BlockState& state);
  /// A new state; saves the block to `strokes` first where needed. False: there is no room for it, nothing is changed.
  /// Writer only.
  bool setBlock(std::size_t block, const BlockState& state, StrokeHistory* strokes);

  /// What a turning bur or a carver takes of a block: of a voxel covered by the fraction g at most what does not fit
  /// beside the tool. Adds the steps of 1/255 taken, by material. Writer only.
  bool cutBlock(glm::ivec3 block, const BlockCut& cut, std::array<std::int64_t, assets::kTissueCount>& steps,
                StrokeHistory* strokes);

  /// By material, and of those that have set.
  double volume_mm3(assets::Tissue material) const;
  double volume_mm3() const { return static_cast<double>(steps_) * grid_.voxelVolume_mm3() / 255.0; }

  /// Order-independent; 0 where nothing is laid.
  std::uint64_t digest() const { return digest_; }

  DirtyBricks& dirtyBricks() { return dirty_; }
  /// As CarvedBone::takeWritten().
  void takeWritten(std::vector<std::size_t>& out);
  /// The 8x8x8 voxels of a brick (i fastest; outside of the volume 0). One reading thread.
  FillingBrick copyBrick(glm::ivec3 brick) const;

  /// In the order of the grid: the filling's part of each voxel, its assets::Tissue, its increment.
  struct Volumes {
    std::vector<std::uint8_t> laid, tissue, increment;
  };
  /// O(voxels), allocates; writing thread, or without a writer.
  Volumes volumes() const;
  std::size_t bytes() const { return cubelets_.bytes() + set_.bytes() + mark_.size() * sizeof(std::uint16_t); }

 private:
  void setSetPart(std::size_t block, const BlockState& state);

  assets::VolumeGrid grid_;
  Cubelets cubelets_, set_;
  std::vector<std::uint16_t> mark_;  ///< BlockState::dose by slot and voxel
  std::array<std::int64_t, assets::kTissueCount> steps_of_{};
  std::int64_t steps_ = 0, set_steps_ = 0;
  std::uint64_t digest_ = 0;
  std::size_t first_block_ = 0;
  DirtyBricks dirty_;
  std::vector<std::uint64_t> written_;
};

}  // namespace haptics
