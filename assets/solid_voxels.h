// Solid fractions of a grid wherever they lie in memory: in the grid's own order, or inside a larger array with a
// border. A view, 0..255 per voxel; air outside. Any thread, while whoever owns the values lets them be.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>

#include "assets/volume_grid.h"

namespace assets {

struct SolidVoxels {
  VolumeGrid grid;
  std::span<const std::uint8_t> values;
  std::size_t first = 0, row = 0, slab = 0;  ///< place of voxel (0,0,0), and steps along j and k

  /// Values in the order of the grid, nothing else.
  static SolidVoxels inGridOrder(const VolumeGrid& grid, std::span<const std::uint8_t> values) {
    assert(values.size() == grid.voxelCount());
    const auto row = static_cast<std::size_t>(grid.size.x);
    return {grid, values, 0, row, row * static_cast<std::size_t>(grid.size.y)};
  }

  /// The voxels from (i, j, k) on along i; the voxel must be inside.
  const std::uint8_t* from(glm::ivec3 ijk) const {
    return values.data() + first + static_cast<std::size_t>(ijk.x) + row * static_cast<std::size_t>(ijk.y) +
           slab * static_cast<std::size_t>(ijk.z);
  }
};

}  // namespace assets
