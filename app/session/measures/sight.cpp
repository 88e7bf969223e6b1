#include "app/session/measures/sight.h"

#include <algorithm>
#include <limits>

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

/// The bone while it goes, and who looks on.
class Scene {
 public:
  Scene(const assets::VolumeGrid& grid, const SeenWork& work)
      : grid_(grid),
        work_(work),
        solid_(work.before.begin(), work.before.end()),
        is_out_(!work.out_s || work.is_tooth.size() != work.before.size()) {}

  /// No earlier than before.
  void goTo(double t_s) {
    if (is_out_ || t_s < *work_.out_s) return;
    is_out_ = true;
    for (std::size_t v = 0; v < solid_.size(); ++v)
      if (work_.is_tooth[v] != 0) solid_[v] = 0;
  }
  void remove(const RemovedVoxel& voxel) { solid_[voxel.index] = work_.after[voxel.index]; }

  const EyesPlace& eyes(double t_s) const { return inForce(work_.eyes, t_s).eyes; }
  SightLines lines(double t_s) const {
    const HeldFrom held = work_.held.empty() ? HeldFrom{} : inForce(work_.held, t_s);
    return {grid_,
            solid_,
            work_.soft_tissue,
            {held.assistant_holds, held.flap_aside},
            work_.second_hand != nullptr ? mirrorDiscOf(work_.second_hand->at(t_s)) : std::nullopt};
  }

 private:
  const assets::VolumeGrid& grid_;
  const SeenWork& work_;
  Solid solid_;
  bool is_out_;
};

}  // namespace

SightOfWork sightOfWork(const RemovalClock& clock, const SeenWork& work) {
  SightOfWork sight;
  if (work.eyes.empty()) return sight;
  std::vector<const RemovedVoxel*> by_time;
  for (const RemovedVoxel& voxel : clock.removed())
    if (voxel.t_s) by_time.push_back(&voxel);
  std::ranges::stable_sort(by_time, {}, [](const RemovedVoxel* voxel) { return *voxel->t_s; });

  Scene scene(clock.grid(), work);
  auto end = work.ends.begin();
  const auto look_until = [&](double t_s) {
    for (; end != work.ends.end() && end->t_s < t_s; ++end) {
      scene.goTo(end->t_s);
      const SightLines lines = scene.lines(end->t_s);
      if (lines.mirror && lines.isInMirror(end->at_P_mm, scene.eyes(end->t_s))) sight.mirror_view_s += end->dt_s;
    }
  };
  const std::size_t every = 1 + by_time.size() / kMostLookedAt;
  double hidden = 0.0, in_mirror = 0.0, all = 0.0;
  for (std::size_t first = 0; first < by_time.size();) {
    const double t_s = *by_time[first]->t_s;
    look_until(t_s);
    scene.goTo(t_s);
    // What one tick took is gone before anybody looks.
    std::size_t last = first;
    for (; last < by_time.size() && *by_time[last]->t_s == t_s; ++last) scene.remove(*by_time[last]);
    const EyesPlace& eyes = scene.eyes(t_s);
    const SightLines lines = scene.lines(t_s);
    for (; first < last; ++first) {
      if (first % every != 0) continue;
      const RemovedVoxel& voxel = *by_time[first];
      all += voxel.share;
      if (lines.isHidden(voxel.ijk, eyes)) hidden += voxel.share;
      if (lines.mirror && lines.isInMirror(voxel.ijk, eyes)) in_mirror += voxel.share;
    }
  }
  look_until(std::numeric_limits<double>::infinity());
  if (all > 0.0) sight.hidden = hidden / all, sight.in_mirror = in_mirror / all;
  return sight;
}

}  // namespace app
