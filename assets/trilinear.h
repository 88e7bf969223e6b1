// Trilinear interpolation of a value per voxel at any point in P. Any thread; eight reads.
#pragma once

#include "assets/volume_grid.h"

namespace assets {

/// `value(ijk)` for any index, outside of the grid too.
template <class Value>
double trilinearAt(const VolumeGrid& grid, const glm::dvec3& p_P_mm, const Value& value) {
  const glm::dvec3 at = grid.indexFromPoint(p_P_mm), low = glm::floor(at), f = at - low;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step = cornerOffset(corner);
    const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(step));
    sum += w.x * w.y * w.z * value(glm::ivec3(low) + step);
  }
  return sum;
}

}  // namespace assets
