// Geometry of a volume: a box of cubic voxels with axes along P (LPS), i fastest. Integer indices denote voxels.
// Index (0,0,0) is the voxel whose centre is `origin_P_mm`. Plain data, trivially copyable; any thread.
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

namespace assets {

/// Edge of a brick in voxels: the unit of transfer of carved bone, of empty-space skipping and of upload.
inline constexpr int kBrickVoxels = 8;

/// Elements of a box, and the index of one of them, i fastest.
inline std::size_t countIn(glm::ivec3 size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}
inline std::size_t indexIn(glm::ivec3 size, glm::ivec3 ijk) {
  return (static_cast<std::size_t>(ijk.z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(ijk.y)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(ijk.x);
}

/// The element of an index: the inverse of indexIn().
inline glm::ivec3 elementAt(glm::ivec3 size, std::size_t index) {
  const std::size_t row = static_cast<std::size_t>(size.x), layer = row * static_cast<std::size_t>(size.y);
  return {static_cast<int>(index % row), static_cast<int>(index % layer / row), static_cast<int>(index / layer)};
}

/// Offset of corner 0..7 of a cell, i fastest.
inline glm::ivec3 cornerOffset(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }

struct VolumeGrid {
  glm::ivec3 size{0};           ///< voxels along i, j, k
  double spacing_mm = 0.0;      ///< edge of a voxel
  glm::dvec3 origin_P_mm{0.0};  ///< centre of voxel (0,0,0)

  bool operator==(const VolumeGrid&) const = default;

  std::size_t voxelCount() const { return countIn(size); }
  std::size_t index(glm::ivec3 ijk) const { return indexIn(size, ijk); }
  bool contains(glm::ivec3 ijk) const {
    return ijk.x >= 0 && ijk.y >= 0 && ijk.z >= 0 && ijk.x < size.x && ijk.y < size.y && ijk.z < size.z;
  }
  glm::dvec3 centre_P_mm(glm::ivec3 ijk) const { return origin_P_mm + spacing_mm * glm::dvec3(ijk); }
  /// Continuous index: integer at voxel centres.
  glm::dvec3 indexFromPoint(const glm::dvec3& p_P_mm) const { return (p_P_mm - origin_P_mm) / spacing_mm; }
  double voxelVolume_mm3() const { return spacing_mm * spacing_mm * spacing_mm; }

  /// Bricks along each axis; the last one may be partly outside the volume.
  glm::ivec3 bricks() const { return (size + (kBrickVoxels - 1)) / kBrickVoxels; }
};

/// visit(ijk) from `low` to before `end`, i fastest.
template <class Visit>
void forVoxels(glm::ivec3 low, glm::ivec3 end, const Visit& visit) {
  for (int k = low.z; k < end.z; ++k)
    for (int j = low.y; j < end.y; ++j)
      for (int i = low.x; i < end.x; ++i) visit(glm::ivec3(i, j, k));
}

/// visit(ijk, index) over a whole grid.
template <class Visit>
void forVoxels(const VolumeGrid& grid, const Visit& visit) {
  std::size_t v = 0;
  forVoxels(glm::ivec3(0), grid.size, [&](glm::ivec3 ijk) { visit(ijk, v++); });
}

/// Number of voxels and sum of their indices; exact for any order.
struct VoxelSum {
  double count = 0.0;
  glm::dvec3 sum{0.0};
};

/// Sum over the voxels v for which belongs(v).
template <class Belongs>
VoxelSum voxelSum(const VolumeGrid& grid, const Belongs& belongs) {
  VoxelSum found;
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!belongs(v)) return;
    found.sum += glm::dvec3(ijk);
    found.count += 1.0;
  });
  return found;
}

}  // namespace assets
