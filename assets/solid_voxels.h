// View of the solid fractions of a grid, 0..255 per voxel, in grid order or inside a larger array with a border.
// Air outside. Any thread, as long as the values are not changed.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>

#include "assets/volume_grid.h"

namespace assets {

struct SolidVoxels {
  VolumeGrid grid;
  std::span<const std::uint8_t> values;
  std::size_t first = 0, row = 0, slab = 0;  ///< offset of voxel (0,0,0), strides along j and k

  /// Values in grid order, without a border.
  static SolidVoxels inGridOrder(const VolumeGrid& grid, std::span<const std::uint8_t> values) {
    assert(values.size() == grid.voxelCount());
    const auto row = static_cast<std::size_t>(grid.size.x);
    return {grid, values, 0, row, row * static_cast<std::size_t>(grid.size.y)};
  }

  /// Pointer to voxel (i, j, k), which must be inside; its row continues along i.
  const std::uint8_t* from(glm::ivec3 ijk) const {
    return values.data() + first + static_cast<std::size_t>(ijk.x) + row * static_cast<std::size_t>(ijk.y) +
           slab * static_cast<std::size_t>(ijk.z);
  }
};

}  // namespace assets
