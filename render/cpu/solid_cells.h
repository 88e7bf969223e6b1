// The solid field as the CPU's rays read it. A cell is the cube between eight voxels; of every cell four values lie in
// one 32-bit word, (j,k) (j+1,k) (j,k+1) (j+1,k+1), so the next word holds the other four and one 64-bit load fetches
// all that a trilinear sample needs. Cells are kept in bricks of 8x8x8 (9 words a row, so that no row ends early) and
// only where a value is assets::kHalfSolid or more, as on the surface and all that shows in the translucent view: an
// eighth of a jaw. A table says for every brick which of its eight halves hold something solid and where its cells are,
// or how many bricks away (Chebyshev) the next ones with cells are; it has a border of bricks all round, for the border
// of air. Distances left stale by carving are too small, which costs time and shows the same image. One thread; the
// reading of tables and cells by many at once. Update: about 0.4 us per brick touched.
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

  /// The field is borrowed: it must outlive its cells.
  explicit SolidCells(const BorderedField<std::uint8_t>& solid);

  /// These voxels of the field have changed.
  void touch(const VoxelBox& voxels);
  /// Brings cells and table up to date; distances only where a image would otherwise miss something.
  void refresh();
  /// Makes the distances exact, where they are not.
  void rebuildIfStale();

  /// What the kernels read. Places count from the corner of the border: voxel (0,0,0) lies at (kEdge, kEdge, kEdge).
  const BorderedField<std::uint8_t>& solid() const { return *solid_; }
  glm::ivec3 bricks() const { return occupancy_.bricks(); }
  const std::uint32_t* words() const { return words_.data(); }
  /// i fastest: the number of its brick of words() times 256, plus a bit for each 4x4x4 cells in which something
  /// reaches 128 (bit i + 2 j + 4 k); or minus the distance in bricks.
  const std::int32_t* table() const { return table_.data(); }
  std::size_t bytes() const;

 private:
  std::uint32_t* wordsOf(std::int32_t slot) { return &words_[static_cast<std::size_t>(slot) * kBrickWords]; }
  void writeTable();

  const BorderedField<std::uint8_t>* solid_;
  Occupancy occupancy_;  ///< marks: solid eighths, as in the table
  std::vector<std::uint32_t> words_;
  std::vector<std::int32_t> slot_;  ///< number of each brick with cells; -1: none
  std::vector<std::int32_t> table_;
};

}  // namespace render
