// Solid fraction at any point: trilinear between voxel centres, air outside. Frame P, mm. Any thread; eight reads.
#pragma once

#include "assets/ct_volume.h"
#include "assets/trilinear.h"

namespace assets {

/// 0..1.
inline double solidAt(const CtVolume& ct, const glm::dvec3& p_P_mm) {
  return trilinearAt(ct.grid, p_P_mm, [&](glm::ivec3 ijk) {
    return ct.grid.contains(ijk) ? ct.solid[ct.grid.index(ijk)] / 255.0 : 0.0;
  });
}

}  // namespace assets
