#include "app/session/measures/sight.h"

#include <algorithm>

#include "app/session/measures/sight_lines.h"

namespace app {
namespace {

using Solid = std::vector<std::uint8_t>;

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
    const SightLines lines{grid, solid, work.soft_tissue, {held.assistant_holds, held.flap_aside}};
    for (; first < end; ++first) {
      if (first % every != 0) continue;
      const RemovedVoxel& voxel = *by_time[first];
      all += voxel.share;
      if (lines.isHidden(voxel.ijk, eyes)) hidden += voxel.share;
    }
  }
  return hidden / all;
}

}  // namespace app
