// A tooth's fine field as measures read it, block by block, however it is kept: 4x4x4 voxels of the solid fraction
// 0..255, voxel (i, j, k) of block (i, j, k) / 4 at (k & 3) 16 + (j & 3) 4 + (i & 3). Outside of the grid is air. Frame
// P, mm. Any thread that may read it.
#pragma once

#include <cstdint>

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
  /// 0..1, linear between the centres of voxels.
  double at(const glm::dvec3& p_P_mm) const {
    return assets::trilinearAt(grid(), p_P_mm, [this](glm::ivec3 ijk) { return voxel(ijk) / 255.0; });
  }

 protected:
  FineSolid(const FineSolid&) = default;
  FineSolid& operator=(const FineSolid&) = default;
};

/// visit(ijk, solid removed) for every voxel that lost some.
template <class Visit>
void forRemoved(const FineSolid& before, const FineSolid& after, const Visit& visit) {
  const glm::ivec3 blocks = (before.grid().size + (FineSolid::kEdge - 1)) / FineSolid::kEdge;
  assets::forVoxels(glm::ivec3(0), blocks, [&](glm::ivec3 block) {
    const FineSolid::Block was = before.block(block), is = after.block(block);
    if (was.bytes == is.bytes && was.same == is.same) return;
    std::size_t v = 0;
    assets::forVoxels(block * FineSolid::kEdge, (block + 1) * FineSolid::kEdge, [&](glm::ivec3 ijk) {
      const int lost = was.at(v) - is.at(v);
      ++v;
      if (lost > 0) visit(ijk, lost / 255.0);
    });
  });
}

}  // namespace app
