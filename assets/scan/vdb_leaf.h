// Maps the voxels of an OpenVDB leaf (8 x 8 x 8, k fastest) to a volume (i fastest). Any thread.
#pragma once

#include <cstdint>

#include "assets/volume_grid.h"

namespace assets {

inline constexpr int kLeafVoxels = 8;

/// Calls voxel(offset in leaf, index in volume) for each voxel of the leaf at `origin` inside the volume.
template <class Voxel>
void forEachLeafVoxel(const glm::ivec3& origin, const VolumeGrid& grid, const Voxel& voxel) {
  const glm::ivec3 first = glm::max(glm::ivec3(0), -origin);
  const glm::ivec3 end = glm::min(glm::ivec3(kLeafVoxels), grid.size - origin);
  for (int i = first.x; i < end.x; ++i)
    for (int j = first.y; j < end.y; ++j)
      for (int k = first.z; k < end.z; ++k)
        voxel(static_cast<std::uint32_t>((i * kLeafVoxels + j) * kLeafVoxels + k),
              grid.index(origin + glm::ivec3(i, j, k)));
}

}  // namespace assets
