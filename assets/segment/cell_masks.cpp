#include "assets/segment/cell_masks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assets/scan/exact_distance.h"

namespace assets {
namespace {

/// The mask in the middle of a box that is larger by `margin` on all sides, and back.
CellMask padded(glm::ivec3 size, std::span<const std::uint8_t> mask, int margin) {
  const glm::ivec3 large = size + 2 * margin;
  CellMask out(countIn(large), 0);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      std::copy_n(&mask[indexIn(size, {0, j, k})], size.x, &out[indexIn(large, {margin, j + margin, k + margin})]);
  return out;
}

}  // namespace

CellBox boxOfCells(glm::ivec3 size, std::span<const std::uint8_t> mask) {
  CellBox box{size, glm::ivec3(0)};
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const std::uint8_t* const row = &mask[indexIn(size, {0, j, k})];
      for (int i = 0; i < size.x; ++i)
        if (row[i] != 0) {
          box.low = glm::min(box.low, glm::ivec3(i, j, k));
          box.end = glm::max(box.end, glm::ivec3(i + 1, j + 1, k + 1));
        }
    }
  return box;
}

CellPieces piecesOfCells(glm::ivec3 size, std::span<const std::uint8_t> mask) {
  CellPieces pieces{std::vector<std::int32_t>(mask.size(), 0), {0}};
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < mask.size(); ++first) {
    if (mask[first] == 0 || pieces.of[first] != 0) continue;
    const auto number = static_cast<std::int32_t>(pieces.cells.size());
    std::size_t count = 0;
    pieces.of[first] = number;
    open.push_back(first);
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      ++count;
      forNeighbours(size, cell, [&](std::size_t next) {
        if (mask[next] == 0 || pieces.of[next] != 0) return;
        pieces.of[next] = number;
        open.push_back(next);
      });
    }
    pieces.cells.push_back(count);
  }
  return pieces;
}

CellMask largestPiece(glm::ivec3 size, std::span<const std::uint8_t> mask) {
  const CellPieces pieces = piecesOfCells(size, mask);
  const auto largest = static_cast<std::int32_t>(std::ranges::max_element(pieces.cells) - pieces.cells.begin());
  CellMask out(mask.size());
  std::ranges::transform(pieces.of, out.begin(), [largest](std::int32_t number) -> std::uint8_t {
    return number != 0 && number == largest ? 1 : 0;
  });
  return out;
}

std::vector<float> depthInside_mm(glm::ivec3 size, double spacing_mm, std::span<const std::uint8_t> mask) {
  CellMask outside(mask.size());
  std::ranges::transform(mask, outside.begin(), [](std::uint8_t in) -> std::uint8_t { return in == 0 ? 1 : 0; });
  std::vector<float> depth_mm = exactDistance_mm(size, spacing_mm, outside);
  // What fills the box has no outside.
  const auto most_mm = static_cast<float>(spacing_mm * glm::length(glm::dvec3(size)));
  for (float& depth : depth_mm) depth = std::clamp(depth, 0.0F, most_mm);
  return depth_mm;
}

CellMask grownByOne(glm::ivec3 size, std::span<const std::uint8_t> mask) {
  CellMask out(mask.size());
  tbb::parallel_for(0, size.z, [&](int k) {
    for (std::size_t cell = indexIn(size, {0, 0, k}), end = indexIn(size, {0, 0, k + 1}); cell < end; ++cell) {
      bool is_in = mask[cell] != 0;
      if (!is_in) forNeighbours(size, cell, [&](std::size_t next) { is_in = is_in || mask[next] != 0; });
      out[cell] = is_in ? 1 : 0;
    }
  });
  return out;
}

CellMask shrunkByOne(glm::ivec3 size, std::span<const std::uint8_t> mask) {
  CellMask out(mask.size());
  tbb::parallel_for(0, size.z, [&](int k) {
    for (std::size_t cell = indexIn(size, {0, 0, k}), end = indexIn(size, {0, 0, k + 1}); cell < end; ++cell) {
      int inside = 0;
      if (mask[cell] != 0) forNeighbours(size, cell, [&](std::size_t next) { inside += mask[next] != 0 ? 1 : 0; });
      out[cell] = inside == 6 ? 1 : 0;
    }
  });
  return out;
}

CellMask grownBy(glm::ivec3 size, std::span<const std::uint8_t> mask, double reach) {
  const std::vector<float> distance = exactDistance_mm(size, 1.0, mask);
  CellMask out(mask.size());
  std::ranges::transform(distance, out.begin(), [reach](float d) -> std::uint8_t { return d <= reach ? 1 : 0; });
  return out;
}

CellMask closedBy(glm::ivec3 size, std::span<const std::uint8_t> mask, double radius) {
  const int margin = static_cast<int>(std::ceil(radius)) + 1;
  const glm::ivec3 large = size + 2 * margin;
  const std::vector<float> depth = depthInside_mm(large, 1.0, grownBy(large, padded(size, mask, margin), radius));
  CellMask out(mask.size());
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    out[n] = mask[n] != 0 || depth[indexIn(large, ijk + margin)] > radius ? 1 : 0;
  });
  return out;
}

void fillHolesAcross(glm::ivec3 size, int axis, CellMask& mask) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto columns = static_cast<std::size_t>(size[u]), rows = static_cast<std::size_t>(size[v]);
  tbb::parallel_for(0, size[axis], [&](int layer) {
    const auto cell_at = [&](std::size_t n) {
      glm::ivec3 ijk(0);
      ijk[axis] = layer, ijk[u] = static_cast<int>(n % columns), ijk[v] = static_cast<int>(n / columns);
      return indexIn(size, ijk);
    };
    std::vector<std::uint8_t> is_outer(columns * rows, 0);
    std::vector<std::size_t> open;
    const auto reach = [&](std::size_t n) {
      if (is_outer[n] != 0 || mask[cell_at(n)] != 0) return;
      is_outer[n] = 1;
      open.push_back(n);
    };
    for (std::size_t n = 0; n < columns; ++n) reach(n), reach(columns * (rows - 1) + n);
    for (std::size_t n = 0; n < rows; ++n) reach(columns * n), reach(columns * n + columns - 1);
    while (!open.empty()) {
      const std::size_t n = open.back();
      open.pop_back();
      if (n % columns > 0) reach(n - 1);
      if (n % columns + 1 < columns) reach(n + 1);
      if (n >= columns) reach(n - columns);
      if (n + columns < columns * rows) reach(n + columns);
    }
    for (std::size_t n = 0; n < columns * rows; ++n)
      if (is_outer[n] == 0) mask[cell_at(n)] = 1;
  });
}

}  // namespace assets
