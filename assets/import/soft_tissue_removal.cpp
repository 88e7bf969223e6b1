#include "assets/import/soft_tissue_removal.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "assets/scan/exact_distance.h"

namespace assets {
namespace {

constexpr double kCell_mm = 1.0;
constexpr double kBoneShare = 0.25;  // of a cell's voxels
constexpr double kSmallestBone_mm3 = 500.0;
constexpr int kSoft_hu = -300;
constexpr std::int16_t kRemoved_hu = -1000;

struct Cells {
  int edge = 1;  ///< voxels
  glm::ivec3 size{0};
};

Cells cellsOf(const VolumeGrid& grid) {
  Cells cells;
  cells.edge = std::max(1, static_cast<int>(std::lround(kCell_mm / grid.spacing_mm)));
  cells.size = (grid.size + (cells.edge - 1)) / cells.edge;
  return cells;
}

std::vector<std::uint8_t> boneCells(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                                    const Cells& cells, double bone_hu) {
  std::vector<std::uint8_t> is_bone(countIn(cells.size));
  tbb::parallel_for(tbb::blocked_range<int>(0, cells.size.z), [&](const auto& range) {
    forVoxels({0, 0, range.begin()}, {cells.size.x, cells.size.y, range.end()}, [&](glm::ivec3 cell) {
      const glm::ivec3 low = cell * cells.edge, end = glm::min(low + cells.edge, grid.size);
      int dense = 0;
      forVoxels(low, end, [&](glm::ivec3 ijk) { dense += hounsfield[grid.index(ijk)] >= bone_hu ? 1 : 0; });
      const glm::ivec3 voxels = end - low;
      is_bone[indexIn(cells.size, cell)] = dense >= kBoneShare * voxels.x * voxels.y * voxels.z ? 1 : 0;
    });
  });
  return is_bone;
}

/// Removes pieces, connected by faces, of fewer than `fewest` cells.
void dropSmallPieces(const Cells& cells, std::size_t fewest, std::vector<std::uint8_t>& is_bone) {
  constexpr std::array<glm::ivec3, 6> kFaces = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  constexpr std::uint8_t kSeen = 2;
  std::vector<std::size_t> piece;
  for (std::size_t start = 0; start < is_bone.size(); ++start) {
    if (is_bone[start] != 1) continue;
    piece.assign(1, start);
    is_bone[start] = kSeen;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      const glm::ivec3 at = elementAt(cells.size, piece[n]);
      for (const glm::ivec3& step : kFaces) {
        const glm::ivec3 next = at + step;
        if (glm::any(glm::lessThan(next, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(next, cells.size))) continue;
        const std::size_t index = indexIn(cells.size, next);
        if (is_bone[index] != 1) continue;
        is_bone[index] = kSeen;
        piece.push_back(index);
      }
    }
    if (piece.size() < fewest)
      for (const std::size_t index : piece) is_bone[index] = 0;
  }
}

}  // namespace

double removeDistantSoftTissue(const VolumeGrid& grid, std::vector<std::int16_t>& hounsfield, double bone_hu,
                               double distance_mm) {
  const Cells cells = cellsOf(grid);
  const double cell_mm = cells.edge * grid.spacing_mm;
  std::vector<std::uint8_t> is_bone = boneCells(grid, hounsfield, cells, bone_hu);
  dropSmallPieces(cells, static_cast<std::size_t>(std::ceil(kSmallestBone_mm3 / std::pow(cell_mm, 3.0))), is_bone);
  const std::vector<float> from_bone_mm = exactDistance_mm(cells.size, cell_mm, is_bone);
  // Between any two points of two cells lies at most a cell's diagonal more than between their centres.
  const double reach_mm = std::max(0.0, distance_mm - std::sqrt(3.0) * cell_mm);
  std::atomic<std::uint64_t> removed{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size.z), [&](const auto& range) {
    std::uint64_t count = 0;
    forVoxels({0, 0, range.begin()}, {grid.size.x, grid.size.y, range.end()}, [&](glm::ivec3 ijk) {
      if (static_cast<double>(from_bone_mm[indexIn(cells.size, ijk / cells.edge)]) <= reach_mm) return;
      std::int16_t& value = hounsfield[grid.index(ijk)];
      count += value > kSoft_hu ? 1 : 0;
      value = kRemoved_hu;
    });
    removed += count;
  });
  return static_cast<double>(removed) * grid.voxelVolume_mm3();
}

}  // namespace assets
