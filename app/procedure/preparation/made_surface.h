// The surface that a preparation has made, or should have made, as places with normal and area: where two neighbouring
// voxels stand on both sides of one half, along the axis that the normal is nearest to. Frame P, mm. Any thread; 50,000
// of them on a crown at 0.05 mm, some 50 ms.
#pragma once

#include <cmath>

#include "app/procedure/preparation/crown.h"

namespace app {

struct SurfacePlace {
  glm::dvec3 p_P_mm{0.0};
  glm::dvec3 out_P{0.0};  ///< unit, out of what is left
  double area_mm2 = 0.0;
  glm::ivec3 voxel{0};  ///< solid side
};

/// Cut, or to be cut: not where tooth, made and ideal agree.
inline bool isPrepared(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal, glm::ivec3 ijk) {
  constexpr int kSome = 40;
  const int was = crown.solid.voxel(ijk);
  return was - made.voxel(ijk) > kSome || was - ideal.voxel(ijk) > kSome;
}

/// `counts(voxel on the solid side, on the other)`.
template <class Counts, class Visit>
void forSurface(const BoxBytes& made, const Counts& counts, const Visit& visit) {
  constexpr int kHalf = 128;
  const assets::VolumeGrid& grid = made.grid();
  // Differences over two voxels, smoothed across by 1 2 1.
  const auto slope = [&](glm::ivec3 ijk) {
    glm::dvec3 out(0.0);
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        const double w = (a == 0 ? 2.0 : 1.0) * (b == 0 ? 2.0 : 1.0);
        out.x += w * (made.voxel(ijk + glm::ivec3(-1, a, b)) - made.voxel(ijk + glm::ivec3(1, a, b)));
        out.y += w * (made.voxel(ijk + glm::ivec3(a, -1, b)) - made.voxel(ijk + glm::ivec3(a, 1, b)));
        out.z += w * (made.voxel(ijk + glm::ivec3(a, b, -1)) - made.voxel(ijk + glm::ivec3(a, b, 1)));
      }
    return out;
  };
  assets::forVoxels(glm::ivec3(1), grid.size - 1, [&](glm::ivec3 ijk) {
    const int here = made.bytes()[grid.index(ijk)];
    if (here < kHalf) return;
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        glm::ivec3 next = ijk;
        next[axis] += way;
        const int there = made.bytes()[grid.index(next)];
        if (there >= kHalf || !counts(ijk, next)) continue;
        const double share = (here - 127.5) / (here - there);
        glm::dvec3 out = glm::mix(slope(ijk), slope(next), share);
        const double length = glm::length(out);
        if (length <= 0.0) continue;
        out /= length;
        // Told once: along the axis that it faces most.
        const double along = out[axis] * way;
        if (along < std::abs(out[(axis + 1) % 3]) || along <= std::abs(out[(axis + 2) % 3])) continue;
        glm::dvec3 index(ijk);
        index[axis] += way * share;
        visit(SurfacePlace{grid.origin_P_mm + grid.spacing_mm * index, out, grid.spacing_mm * grid.spacing_mm / along,
                           ijk});
      }
  });
}

template <class Visit>
void forPreparedSurface(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal, const Visit& visit) {
  forSurface(
      made,
      [&](glm::ivec3 ijk, glm::ivec3 next) {
        return crown.isTooth(ijk) && (isPrepared(crown, made, ideal, ijk) || isPrepared(crown, made, ideal, next));
      },
      visit);
}

}  // namespace app
