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
  using assets::Tissue;
  const auto tissue = static_cast<Tissue>(label);
  return label >= static_cast<std::uint8_t>(Tissue::composite_soft) && tissue != Tissue::composite &&
         tissue != Tissue::glass_ionomer && tissue != Tissue::amalgam;
}

/// What a material becomes: after so much light, or so long after its increment was begun (0: not by that); itself
/// where neither sets it. Light: reference/sisters 5.4. Amalgam: 4.5 min, an admixed alloy (Dispersalloy; University of
/// Iowa, Operative Dentistry). Glass ionomer: 4.83 min net, Fuji II (Ghashami 2022, by ISO 9917-1).
struct Setting {
  assets::Tissue into;
  double light_s = 0.0, by_itself_s = 0.0;
};
constexpr Setting settingOf(std::uint8_t label) {
  using assets::Tissue;
  switch (static_cast<Tissue>(label)) {
    case Tissue::composite_soft:
      return {Tissue::composite, 10.0, 0.0};
    case Tissue::glass_ionomer_soft:
      return {Tissue::glass_ionomer, 20.0, 290.0};
    case Tissue::amalgam_soft:
      return {Tissue::amalgam, 0.0, 270.0};
    default:
      return {static_cast<Tissue>(label), 0.0, 0.0};
  }
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

  /// In the order of the grid: the filling's part of each voxel, its assets::Tissue, its increment, its light (empty:
  /// none has any); by increment, from 1, how long ago it was begun (one that is not named: now).
  struct Volumes {
    std::vector<std::uint8_t> laid{}, tissue{}, increment{};
    std::vector<std::uint16_t> light{};
    std::vector<double> age_s{};
  };

  explicit Filling(const assets::VolumeGrid& grid);

  /// What lies there when a servo takes over, of a stranger's bytes too. Before that, on an empty filling; allocates.
  void begin(const Volumes& volumes);
  /// Of what begin() put there: the newest increment, what it is of where more of it may be laid (unlabelled: it is
  /// ended), ages.
  struct Begun {
    unsigned increment = 0;
    assets::Tissue material = assets::Tissue::unlabelled;
    std::array<double, kMostIncrements + 1> age_s{};
  };
  const Begun& begun() const { return begun_; }

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

  /// O(voxels), allocates; writing thread, or without a writer. Without ages, which the servo has.
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
  Begun begun_;
  DirtyBricks dirty_;
  std::vector<std::uint64_t> written_;
};

}  // namespace haptics
