#include "app/session/measures/sight.h"

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

using Solid = std::vector<std::uint8_t>;

bool isHiddenByBone(const assets::VolumeGrid& grid, const Solid& solid, glm::ivec3 from, const glm::dvec3& way_P) {
  const glm::dvec3 step = kStep_voxels * way_P;
  glm::dvec3 at = glm::dvec3(from) + kOwn_voxels * way_P + 0.5;
  const glm::dvec3 size(grid.size);
  for (; at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < size.x && at.y < size.y && at.z < size.z; at += step) {
    const glm::ivec3 ijk(at);
    if (ijk != from && solid[grid.index(ijk)] >= assets::kHalfSolid) return true;
  }
  return false;
}

bool givesWay(assets::SoftTissue tissue, const HeldFrom& held) {
  using assets::SoftTissue;
  const bool is_gum = tissue == SoftTissue::gingiva || tissue == SoftTissue::flap;
  return is_gum ? held.flap_aside : held.assistant_holds;
}

bool isHiddenBySoftTissue(const assets::SoftTissueField& soft, const glm::dvec3& from_P_mm, const glm::dvec3& way_P,
                          double length_mm, const HeldFrom& held) {
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

/// The last that has begun; the first where none has.
template <class From>
const From& inForce(std::span<const From> list, double t_s) {
  const auto later = std::ranges::upper_bound(list, t_s, {}, &From::t_s);
  return later == list.begin() ? list.front() : *(later - 1);
}

}  // namespace

std::optional<double> shareOutOfSight(const RemovalClock& clock, const SeenWork& work) {
  std::vector<const RemovedVoxel*> by_time;
  for (const RemovedVoxel& voxel : clock.removed())
    if (voxel.t_s) by_time.push_back(&voxel);
  if (by_time.empty() || work.eyes.empty()) return {};
  std::ranges::stable_sort(by_time, {}, [](const RemovedVoxel* voxel) { return *voxel->t_s; });

  const assets::VolumeGrid& grid = clock.grid();
  Solid solid(work.before.begin(), work.before.end());
  const std::size_t every = 1 + by_time.size() / kMostLookedAt;
  double hidden = 0.0, all = 0.0;
  bool is_out = !work.out_s || work.is_tooth.size() != solid.size();
  for (std::size_t first = 0; first < by_time.size();) {
    if (!is_out && *by_time[first]->t_s >= *work.out_s) {
      is_out = true;
      for (std::size_t v = 0; v < solid.size(); ++v)
        if (work.is_tooth[v] != 0) solid[v] = 0;
    }
    // What one tick took is gone before anybody looks.
    std::size_t end = first;
    const double t_s = *by_time[first]->t_s;
    for (; end < by_time.size() && *by_time[end]->t_s == t_s; ++end)
      solid[by_time[end]->index] = work.after[by_time[end]->index];
    const EyesPlace& eyes = inForce(work.eyes, t_s).eyes;
    const HeldFrom held = work.held.empty() ? HeldFrom{} : inForce(work.held, t_s);
    for (; first < end; ++first) {
      if (first % every != 0) continue;
      const RemovedVoxel& voxel = *by_time[first];
      const glm::dvec3 p = grid.centre_P_mm(voxel.ijk);
      const auto is_hidden_from = [&](const glm::dvec3& eye_P_mm) {
        const double length_mm = glm::distance(eye_P_mm, p);
        if (!(length_mm > grid.spacing_mm)) return false;
        const glm::dvec3 way_P = (eye_P_mm - p) / length_mm;
        return isHiddenByBone(grid, solid, voxel.ijk, way_P) ||
               isHiddenBySoftTissue(work.soft_tissue, p, way_P, length_mm, held);
      };
      all += voxel.share;
      if (is_hidden_from(eyes.left_P_mm) && is_hidden_from(eyes.right_P_mm)) hidden += voxel.share;
    }
  }
  return hidden / all;
}

}  // namespace app
