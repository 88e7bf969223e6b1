// The solid field as the CPU's rays read it. A cell is the cube between eight voxels. Of every cell four values are in
// one 32-bit word, (j,k) (j+1,k) (j,k+1) (j+1,k+1), and the next word holds the other four: one 64-bit load fetches all
// values of a trilinear sample. Cells are stored in bricks of 8x8x8 (9 words a row), only where a value is
// assets::kHalfSolid or more: an eighth of a jaw. A table holds per brick either its solid eighths and the location of
// its cells, or the Chebyshev distance to the next brick with cells; it has a border of one brick. Distances that are
// stale after carving are too small: slower, same image. Written by one thread, read by many. Update: about 0.4 us per
// touched brick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/volume/occupancy.h"

namespace render {

class SolidCells {
 public:
  static constexpr int kEdge = assets::kBrickVoxels, kRowWords = kEdge + 1, kLayerWords = kRowWords * kEdge;
  static constexpr int kBrickWords = kLayerWords * kEdge;

  /// The field must outlive the cells.
  explicit SolidCells(const BorderedField<std::uint8_t>& solid);

  /// These voxels have changed.
  void touch(const VoxelBox& voxels);
  /// Updates cells and table; distances only where rays would otherwise miss something.
  void refresh();
  /// Makes the distances exact.
  void rebuildIfStale();

  /// For the kernels. Positions count from the corner of the border: voxel (0,0,0) is at (kEdge, kEdge, kEdge).
  const BorderedField<std::uint8_t>& solid() const { return *solid_; }
  glm::ivec3 bricks() const { return occupancy_.bricks(); }
  const std::uint32_t* words() const { return words_.data(); }
  /// i fastest: the slot of the brick in words() times 256, plus a bit for each 4x4x4 cells with a value of 128 or more
  /// (bit i + 2 j + 4 k); or minus the distance in bricks.
  const std::int32_t* table() const { return table_.data(); }

 private:
  std::uint32_t* wordsOf(std::int32_t slot) { return &words_[static_cast<std::size_t>(slot) * kBrickWords]; }
  void writeTable();

  const BorderedField<std::uint8_t>* solid_;
  Occupancy occupancy_;  ///< marks: solid eighths, as in the table
  std::vector<std::uint32_t> words_;
  std::vector<std::int32_t> slot_;  ///< in words_ of each brick; -1: none
  std::vector<std::int32_t> table_;
};

}  // namespace render
