// The pieces of a tooth: connected components of its solid voxels (at least half solid; faces connect, edges and
// corners hold nothing), kept up to date brick by brick, with volume, centroid and inertia. Frame and mm of the grid
// given. One thread, not the servo's: it keeps a copy of the bytes. 1 us a changed brick, 20-90 us to join all bricks
// of a tooth; allocates. The same bytes give the same pieces in the same order, whatever the way to them. Method:
// reference/extraction 2.2 (two levels: bit boards in a brick, then union-find across bricks).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "haptics/body/brick_parts.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

inline constexpr double kLeastPiece_mm3 = 1.0;  ///< smaller ones are chips (reference/extraction 2.2)

/// A voxel of at least half counts whole: at a smooth surface that errs to neither side.
struct ToothPiece {
  double volume_mm3 = 0.0;
  glm::dvec3 centroid_mm{0.0};
  glm::dmat3 inertia_mm5{0.0};  ///< about the centroid, for a density of 1
};

/// Each voxel as a cube.
ToothPiece massOf(const VoxelMoments& moments, const assets::VolumeGrid& grid);

class Components {
 public:
  /// Nothing is solid.
  explicit Components(const assets::VolumeGrid& grid);
  /// `solid` in the order of the grid (assert). Joined.
  Components(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);

  const assets::VolumeGrid& grid() const { return grid_; }
  glm::ivec3 bricks() const { return bricks_; }

  /// The 8x8x8 voxels of a brick, i fastest; those beyond the grid must be 0. Takes effect with join().
  void update(glm::ivec3 brick, std::span<const std::uint8_t, 512> solid);
  void join();

  /// Of the last join(), after which no brick may have been updated. The largest first; of equal ones the first voxel
  /// decides.
  std::span<const ToothPiece> pieces() const { return pieces_; }
  /// -1: not solid.
  int pieceAt(glm::ivec3 ijk) const;

  /// As updated. Outside the grid: 0.
  std::uint8_t solidAt(glm::ivec3 ijk) const {
    if (!grid_.contains(ijk)) return 0;
    return solid_[brickOf(ijk) * 512 + assets::indexIn(glm::ivec3(assets::kBrickVoxels), ijk & 7)];
  }
  std::size_t brickOf(glm::ivec3 ijk) const { return assets::indexIn(bricks_, ijk / assets::kBrickVoxels); }
  std::span<const BrickPart> partsIn(std::size_t brick) const { return parts_[brick]; }
  std::size_t pieceOf(std::size_t brick, std::size_t part) const { return piece_of_root_[join_.rootOf(brick, part)]; }
  BrickMask maskOf(std::size_t brick) const;

 private:
  assets::VolumeGrid grid_;
  glm::ivec3 bricks_;
  std::vector<std::uint8_t> solid_;  ///< brick by brick
  std::vector<std::vector<BrickPart>> parts_;
  PartJoin join_;
  std::vector<std::size_t> piece_of_root_;
  std::vector<ToothPiece> pieces_;
};

/// visit(brick number, index of its first voxel) over all bricks, i fastest.
template <class Visit>
void forBricks(glm::ivec3 bricks, const Visit& visit) {
  std::size_t brick = 0;
  assets::forVoxels(glm::ivec3(0), bricks, [&](glm::ivec3 at) { visit(brick++, at * assets::kBrickVoxels); });
}

}  // namespace haptics
