#include "app/session/measures/sight_lines.h"

#include <algorithm>
#include <cmath>

#include "assets/ct_volume.h"

namespace app {
namespace {

constexpr double kOwn_voxels = 1.0;    ///< a voxel does not hide itself
constexpr double kStep_voxels = 0.7;   ///< along a ray
constexpr double kSoftStep_mm = 1.0;   ///< along a ray in the coarse field of soft tissue
constexpr double kSoftDepth_mm = 0.5;  ///< inside it; what a ray grazes hides nothing
constexpr double kRaisedGum_mm = 3.0;  ///< gum at the place itself lies beside the cut

bool isHiddenByBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, glm::ivec3 from,
                    const glm::dvec3& way_P) {
  const glm::dvec3 step = kStep_voxels * way_P;
  glm::dvec3 at = glm::dvec3(from) + kOwn_voxels * way_P + 0.5;
  const glm::dvec3 size(grid.size);
  for (; at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < size.x && at.y < size.y && at.z < size.z; at += step) {
    const glm::ivec3 ijk(at);
    if (ijk != from && solid[grid.index(ijk)] >= assets::kHalfSolid) return true;
  }
  return false;
}

bool givesWay(assets::SoftTissue tissue, const HeldAside& held) {
  using assets::SoftTissue;
  const bool is_gum = tissue == SoftTissue::gingiva || tissue == SoftTissue::flap;
  return is_gum ? held.gum : held.lips;
}

bool isHiddenBySoftTissue(const assets::SoftTissueField& soft, const glm::dvec3& from_P_mm, const glm::dvec3& way_P,
                          double length_mm, const HeldAside& held) {
  if (soft.isEmpty()) return false;
  const double end_mm = std::min(length_mm, 2.0 * glm::length(glm::dvec3(soft.grid.size)) * soft.grid.spacing_mm);
  for (double mm = kRaisedGum_mm; mm < end_mm; mm += kSoftStep_mm) {
    const glm::dvec3 p = from_P_mm + mm * way_P;
    if (soft.at(p).distance_mm > -kSoftDepth_mm) continue;
    const assets::SoftTissue tissue = soft.tissueAt(p);
    if (tissue != assets::SoftTissue::none && !givesWay(tissue, held)) return true;
  }
  return false;
}

}  // namespace

bool SightLines::isHidden(glm::ivec3 voxel, const glm::dvec3& eye_P_mm) const {
  const glm::dvec3 p = grid.centre_P_mm(voxel);
  const double length_mm = glm::distance(eye_P_mm, p);
  if (!(length_mm > grid.spacing_mm)) return false;
  const glm::dvec3 way_P = (eye_P_mm - p) / length_mm;
  return isHiddenByBone(grid, solid, voxel, way_P) || isHiddenBySoftTissue(soft, p, way_P, length_mm, held);
}

bool worksOutOfSight(const SightLines& lines, const haptics::Tick& tick, const haptics::BurShape& head,
                     const EyesPlace& eyes) {
  constexpr int kLeastPlaces = 3;
  if (!tick.drilling || !(tick.removed_mm3 > 0.0)) return false;
  const glm::dquat turn = tick.heldRotation();
  int places = 0, hidden = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 way_T = glm::normalize(glm::dvec3(x, y, z));
        // The layer of voxels around the head.
        const double out_mm = haptics::reach_mm(head, way_T.z) + 0.5 * lines.grid.spacing_mm;
        const glm::ivec3 voxel(glm::round(lines.grid.indexFromPoint(tick.proxy_P.mm + turn * (out_mm * way_T))));
        if (!lines.grid.contains(voxel) || lines.solid[lines.grid.index(voxel)] < assets::kHalfSolid) continue;
        ++places;
        hidden += lines.isHidden(voxel, eyes) ? 1 : 0;
      }
  return places >= kLeastPlaces && 2 * hidden > places;
}

}  // namespace app
