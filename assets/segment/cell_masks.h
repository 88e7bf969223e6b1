// Sets of cells of a box, one byte each, not 0 inside, i fastest: connected pieces, growth, closing, holes. Neighbours
// share a face; beyond the box nothing is inside. Lengths in cells. Deterministic; 5 to 50 ns a cell. Any thread but
// the servo.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

using CellMask = std::vector<std::uint8_t>;

/// Indices of cells below `end`, from `low`.
struct CellBox {
  glm::ivec3 low{0}, end{0};

  glm::ivec3 size() const { return end - low; }
  friend bool operator==(const CellBox&, const CellBox&) = default;
  bool isEmpty() const { return glm::any(glm::lessThanEqual(size(), glm::ivec3(0))); }
  void take(const glm::ivec3& cell) { low = glm::min(low, cell), end = glm::max(end, cell + 1); }
  /// Larger on all sides, within a box of `size`.
  CellBox grown(int cells, glm::ivec3 size) const {
    return {glm::max(low - cells, glm::ivec3(0)), glm::min(end + cells, size)};
  }
};

/// Empty, to be grown by take() and by min and max.
inline CellBox noCells(glm::ivec3 size) { return {size, glm::ivec3(0)}; }

/// visit(ijk, index) over a whole box.
template <class Visit>
void forCells(glm::ivec3 size, const Visit& visit) {
  std::size_t n = 0;
  forVoxels(glm::ivec3(0), size, [&](glm::ivec3 ijk) { visit(ijk, n++); });
}

/// visit(ijk, distance in mm) of the cells of a box within a distance of a point, which is in cells.
template <class Visit>
void forCellsNear(const glm::dvec3& at, double reach_mm, double spacing_mm, glm::ivec3 size, const Visit& visit) {
  const double reach = reach_mm / spacing_mm;
  const glm::ivec3 low = glm::clamp(glm::ivec3(glm::ceil(at - reach)), glm::ivec3(0), size),
                   end = glm::clamp(glm::ivec3(glm::floor(at + reach)) + 1, glm::ivec3(0), size);
  forVoxels(low, end, [&](glm::ivec3 ijk) {
    const double away_mm = spacing_mm * glm::distance(glm::dvec3(ijk), at);
    if (away_mm <= reach_mm) visit(ijk, away_mm);
  });
}

/// visit(index) of the neighbours of a cell within the box.
template <class Visit>
void forNeighbours(glm::ivec3 size, std::size_t cell, const Visit& visit) {
  const glm::ivec3 at = elementAt(size, cell);
  const auto row = static_cast<std::size_t>(size.x), layer = row * static_cast<std::size_t>(size.y);
  if (at.x > 0) visit(cell - 1);
  if (at.x + 1 < size.x) visit(cell + 1);
  if (at.y > 0) visit(cell - row);
  if (at.y + 1 < size.y) visit(cell + row);
  if (at.z > 0) visit(cell - layer);
  if (at.z + 1 < size.z) visit(cell + layer);
}

/// Around the cells inside; empty without any.
CellBox boxOfCells(glm::ivec3 size, std::span<const std::uint8_t> mask);

/// The values of a part of a box.
template <class Value>
std::vector<Value> croppedTo(const CellBox& box, glm::ivec3 size, const std::vector<Value>& values) {
  std::vector<Value> part;
  part.reserve(countIn(box.size()));
  for (int k = box.low.z; k < box.end.z; ++k)
    for (int j = box.low.y; j < box.end.y; ++j) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(indexIn(size, {box.low.x, j, k}));
      part.insert(part.end(), first, first + box.size().x);
    }
  return part;
}

/// Connected pieces: 0 outside, else their number from 1, in the order of their first cells.
struct CellPieces {
  std::vector<std::int32_t> of;
  std::vector<std::size_t> cells;  ///< by number; [0] is 0
};
CellPieces piecesOfCells(glm::ivec3 size, std::span<const std::uint8_t> mask);
/// The largest piece, the first of equal ones.
CellMask largestPiece(glm::ivec3 size, std::span<const std::uint8_t> mask);

/// From every cell inside to the nearest outside, mm, between centres; 0 outside (scan/exact_distance.h).
std::vector<float> depthInside_mm(glm::ivec3 size, double spacing_mm, std::span<const std::uint8_t> mask);

/// With the neighbours; without the cells that have a neighbour outside.
CellMask grownByOne(glm::ivec3 size, std::span<const std::uint8_t> mask);
CellMask shrunkByOne(glm::ivec3 size, std::span<const std::uint8_t> mask);
/// Up to `reach` from the cells inside, exactly (scan/exact_distance.h).
CellMask grownBy(glm::ivec3 size, std::span<const std::uint8_t> mask, double reach);
/// Closed by a ball of that radius; the cost does not depend on it.
CellMask closedBy(glm::ivec3 size, std::span<const std::uint8_t> mask, double radius);
/// Fills what no path within a layer across `axis` joins to the layer's border.
void fillHolesAcross(glm::ivec3 size, int axis, CellMask& mask);

}  // namespace assets
