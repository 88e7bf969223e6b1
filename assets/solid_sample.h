// Solid fraction at any point: trilinear between voxel centres, air outside. Frame P, mm. Any thread; eight reads.
#pragma once

#include "assets/ct_volume.h"

namespace assets {

/// 0..1.
inline double solidAt(const CtVolume& ct, const glm::dvec3& p_P_mm) {
  const glm::dvec3 at = ct.grid.indexFromPoint(p_P_mm), low = glm::floor(at), f = at - low;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step = cornerOffset(corner);
    const glm::ivec3 ijk = glm::ivec3(low) + step;
    if (!ct.grid.contains(ijk)) continue;
    const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(step));
    sum += w.x * w.y * w.z * ct.solid[ct.grid.index(ijk)] / 255.0;
  }
  return sum;
}

}  // namespace assets
