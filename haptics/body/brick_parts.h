// Connected parts of the solid voxels inside one brick of 8x8x8, as bit boards, and their union across bricks. Faces
// connect, edges and corners do not. Voxel indices of the grid; integers alone, so sums are exact in any order. Any
// thread; about 1 us a brick, 0.1 us a part to join. Joining allocates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace haptics {

/// Bit 8 j + i of word k is voxel (i, j, k) of the brick.
using BrickMask = std::array<std::uint64_t, assets::kBrickVoxels>;

using WholeVector = glm::vec<3, std::int64_t>;

/// Sums over voxels of their indices x, y, z.
struct VoxelMoments {
  std::int64_t count = 0;
  WholeVector sum{0};       ///< x, y, z
  WholeVector squares{0};   ///< x x, y y, z z
  WholeVector products{0};  ///< y z, x z, x y

  VoxelMoments& operator+=(const VoxelMoments& other);
  bool operator==(const VoxelMoments&) const = default;
};

struct BrickPart {
  BrickMask mask{};
  VoxelMoments moments;
};

/// The voxels of at least half.
BrickMask solidMask(std::span<const std::uint8_t, 512> solid);
inline bool isEmpty(const BrickMask& mask) {
  std::uint64_t any = 0;
  for (const std::uint64_t word : mask) any |= word;
  return any == 0;
}
inline bool holds(const BrickMask& mask, glm::ivec3 within) {
  return (mask[static_cast<std::size_t>(within.z)] >> (within.y * assets::kBrickVoxels + within.x) & 1u) != 0;
}

/// Replaces `out` by the parts of `mask`, ordered by their first voxel. `corner` is the index of the brick's first
/// voxel.
void findParts(const BrickMask& mask, glm::ivec3 corner, std::vector<BrickPart>& out);

/// Parts of neighbouring bricks that share a face of a voxel, united. Parts are numbered brick by brick; the smallest
/// number of a union stands for it.
class PartJoin {
 public:
  /// `parts` by brick, i fastest.
  void unite(glm::ivec3 bricks, std::span<const std::vector<BrickPart>> parts);

  std::size_t count() const { return root_.size(); }
  std::size_t rootOf(std::size_t brick, std::size_t part) const { return root_[first_[brick] + part]; }

 private:
  std::uint32_t find(std::uint32_t part);
  void link(std::size_t a, std::size_t b);

  std::vector<std::uint32_t> first_, root_;
};

}  // namespace haptics
