// A tooth's fine field as measures read it, block by block, however it is kept: 4x4x4 voxels of the solid fraction
// 0..255, voxel (i, j, k) of block (i, j, k) / 4 at (k & 3) 16 + (j & 3) 4 + (i & 3). Outside of the grid is air. Frame
// P, mm. Any thread that may read it.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/trilinear.h"
#include "assets/volume_grid.h"

namespace app {

class FineSolid {
 public:
  static constexpr int kEdge = 4, kVoxels = 64;

  struct Block {
    const std::uint8_t* bytes = nullptr;  ///< null: all are `same`
    std::uint8_t same = 0;

    std::uint8_t at(std::size_t voxel) const { return bytes == nullptr ? same : bytes[voxel]; }
  };

  FineSolid() = default;
  virtual ~FineSolid() = default;

  virtual const assets::VolumeGrid& grid() const = 0;
  virtual Block block(glm::ivec3 block) const = 0;

  static std::size_t within(glm::ivec3 ijk) {
    return static_cast<std::size_t>((ijk.z & 3) * 16 + (ijk.y & 3) * 4 + (ijk.x & 3));
  }
  std::uint8_t voxel(glm::ivec3 ijk) const {
    return grid().contains(ijk) ? block({ijk.x >> 2, ijk.y >> 2, ijk.z >> 2}).at(within(ijk)) : std::uint8_t{0};
  }
  /// 0..1, linear between the centres of voxels: assets::trilinearAt, bit for bit. Of the eight most lie in one block
  /// or two, which are asked for once.
  double at(const glm::dvec3& p_P_mm) const {
    const assets::VolumeGrid& of = grid();
    const glm::dvec3 at = of.indexFromPoint(p_P_mm), floor = glm::floor(at), f = at - floor;
    const glm::ivec3 low(floor);
    if (!of.contains(low) || !of.contains(low + 1))
      return assets::trilinearAt(of, p_P_mm, [this](glm::ivec3 ijk) { return voxel(ijk) / 255.0; });
    const glm::ivec3 first = low >> 2;
    glm::ivec3 known = first;
    Block here = block(first);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 step = assets::cornerOffset(corner), ijk = low + step, of_block = ijk >> 2;
      if (of_block != known) here = block(of_block), known = of_block;
      const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(step));
      sum += w.x * w.y * w.z * (here.at(within(ijk)) / 255.0);
    }
    return sum;
  }

 protected:
  FineSolid(const FineSolid&) = default;
  FineSolid& operator=(const FineSolid&) = default;
};

/// visit(ijk, solid removed) for every voxel of a block that lost some.
template <class Visit>
void forRemoved(const FineSolid& before, const FineSolid& after, glm::ivec3 block, const Visit& visit) {
  const FineSolid::Block was = before.block(block), is = after.block(block);
  if (was.bytes == is.bytes && was.same == is.same) return;
  std::size_t v = 0;
  assets::forVoxels(block * FineSolid::kEdge, (block + 1) * FineSolid::kEdge, [&](glm::ivec3 ijk) {
    const int lost = was.at(v) - is.at(v);
    ++v;
    if (lost > 0) visit(ijk, lost / 255.0);
  });
}

/// Blocks of which a voxel is not as it was, in the order of the grid.
inline std::vector<glm::ivec3> changedBlocks(const FineSolid& before, const FineSolid& after) {
  std::vector<glm::ivec3> changed;
  assets::forVoxels(glm::ivec3(0), before.grid().size / FineSolid::kEdge, [&](glm::ivec3 block) {
    const FineSolid::Block was = before.block(block), is = after.block(block);
    if (was.bytes == is.bytes && was.same == is.same) return;
    for (std::size_t v = 0; v < FineSolid::kVoxels; ++v)
      if (was.at(v) != is.at(v)) return changed.push_back(block);
  });
  return changed;
}

}  // namespace app
