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

/// Between two places; a voxel does not hide what begins in it.
bool isHiddenByBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, const glm::dvec3& from_index,
                    const glm::dvec3& way_P, double length_mm) {
  const glm::dvec3 step = kStep_voxels * way_P;
  const glm::ivec3 own(glm::floor(from_index + 0.5));
  glm::dvec3 at = from_index + kOwn_voxels * way_P + 0.5;
  const glm::dvec3 size(grid.size);
  double left = length_mm / grid.spacing_mm - kOwn_voxels;
  for (; left > 0.0 && at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < size.x && at.y < size.y && at.z < size.z;
       at += step, left -= kStep_voxels) {
    const glm::ivec3 ijk(at);
    if (ijk != own && solid[grid.index(ijk)] >= assets::kHalfSolid) return true;
  }
  return false;
}

bool givesWay(assets::SoftTissue tissue, const HeldAside& held) {
  using assets::SoftTissue;
  const bool is_gum = tissue == SoftTissue::gingiva || tissue == SoftTissue::flap;
  return is_gum ? held.gum : held.lips;
}

bool isHiddenBySoftTissue(const assets::SoftTissueField& soft, const glm::dvec3& from_P_mm, const glm::dvec3& way_P,
                          double begin_mm, double length_mm, const HeldAside& held) {
  if (soft.isEmpty()) return false;
  const double end_mm = std::min(length_mm, 2.0 * glm::length(glm::dvec3(soft.grid.size)) * soft.grid.spacing_mm);
  for (double mm = begin_mm; mm < end_mm; mm += kSoftStep_mm) {
    const glm::dvec3 p = from_P_mm + mm * way_P;
    if (soft.at(p).distance_mm > -kSoftDepth_mm) continue;
    const assets::SoftTissue tissue = soft.tissueAt(p);
    if (tissue != assets::SoftTissue::none && !givesWay(tissue, held)) return true;
  }
  return false;
}

bool isHiddenBetween(const SightLines& lines, const glm::dvec3& from_P_mm, const glm::dvec3& to_P_mm,
                     double soft_begins_mm) {
  const double length_mm = glm::distance(from_P_mm, to_P_mm);
  if (!(length_mm > lines.grid.spacing_mm)) return false;
  const glm::dvec3 way_P = (to_P_mm - from_P_mm) / length_mm;
  return isHiddenByBone(lines.grid, lines.solid, lines.grid.indexFromPoint(from_P_mm), way_P, length_mm) ||
         isHiddenBySoftTissue(lines.soft, from_P_mm, way_P, soft_begins_mm, length_mm, lines.held);
}

/// Where the way between two places on either side of the mirror's plane crosses its disc; none: it passes beside it.
std::optional<glm::dvec3> crossing(const MirrorDisc& mirror, const glm::dvec3& from_P_mm, const glm::dvec3& to_P_mm,
                                   double radius_mm) {
  const double from = glm::dot(from_P_mm - mirror.centre_P_mm, mirror.out_P),
               to = glm::dot(to_P_mm - mirror.centre_P_mm, mirror.out_P);
  if (!(from * to < 0.0)) return {};
  const glm::dvec3 at = from_P_mm + from / (from - to) * (to_P_mm - from_P_mm);
  if (!(glm::distance(at, mirror.centre_P_mm) <= radius_mm)) return {};
  return at;
}

bool isSeenInMirror(const SightLines& lines, const glm::dvec3& place_P_mm, const glm::dvec3& eye_P_mm) {
  if (!lines.mirror) return false;
  const double eye_out_mm = glm::dot(eye_P_mm - lines.mirror->centre_P_mm, lines.mirror->out_P);
  if (!(eye_out_mm > 0.0)) return false;
  const glm::dvec3 image_P_mm = eye_P_mm - 2.0 * eye_out_mm * lines.mirror->out_P;
  const auto glass_P_mm = crossing(*lines.mirror, place_P_mm, image_P_mm, assets::kMirrorGlassRadius_mm);
  return glass_P_mm && !isHiddenBetween(lines, place_P_mm, *glass_P_mm, kRaisedGum_mm) &&
         !isHiddenBetween(lines, *glass_P_mm, eye_P_mm, 0.0);
}

bool isSeenStraight(const SightLines& lines, const glm::dvec3& place_P_mm, const glm::dvec3& eye_P_mm) {
  if (lines.mirror && crossing(*lines.mirror, place_P_mm, eye_P_mm, assets::kMirrorCasingRadius_mm)) return false;
  return !isHiddenBetween(lines, place_P_mm, eye_P_mm, kRaisedGum_mm);
}

}  // namespace

std::optional<MirrorDisc> mirrorDiscOf(const std::optional<SecondHandPlace>& second_hand) {
  if (!second_hand || !second_hand->is_tracked || second_hand->instrument != assets::SecondInstrument::mirror)
    return {};
  return MirrorDisc{second_hand->X_PO.translation_mm, second_hand->X_PO.rotation * assets::mirrorGlassNormal()};
}

bool SightLines::isHidden(glm::ivec3 voxel, const glm::dvec3& eye_P_mm) const {
  const glm::dvec3 p = grid.centre_P_mm(voxel);
  return !isSeenStraight(*this, p, eye_P_mm) && !isSeenInMirror(*this, p, eye_P_mm);
}

bool SightLines::isInMirror(const glm::dvec3& place_P_mm, const EyesPlace& eyes) const {
  return isSeenInMirror(*this, place_P_mm, eyes.left_P_mm) || isSeenInMirror(*this, place_P_mm, eyes.right_P_mm);
}

bool SightLines::isInMirror(glm::ivec3 voxel, const EyesPlace& eyes) const {
  return isInMirror(grid.centre_P_mm(voxel), eyes);
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
