#include "app/rehearsal/touches.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/session/measures/clearance_measures.h"
#include "assets/tissue.h"
#include "assets/tooth.h"
#include "assets/volume_grid.h"
#include "calibration/geometry/segment.h"

namespace app {
namespace {

/// Ends of the head's axis, inside which its balls of `radius_mm` lie.
std::pair<glm::dvec3, glm::dvec3> axisOf(const haptics::Tick& tick, const haptics::BurShape& head) {
  const double half_mm = std::max(0.0, haptics::halfHeight_mm(head) - head.radius_mm);
  const glm::dvec3 along = tick.heldRotation() * glm::dvec3(0.0, 0.0, half_mm);
  return {tick.proxy_P.mm - along, tick.proxy_P.mm + along};
}

}  // namespace

std::vector<int> teethTouched(const haptics::Tick& tick, const haptics::BurShape& head,
                              const assets::Patient& patient) {
  const assets::CtVolume& ct = patient.ct;
  if (ct.tooth.empty() || tick.depth_mm <= 0.0 || !assets::isTooth(tick.contact_tissue)) return {};
  const auto axis = axisOf(tick, head);
  const glm::dvec3 from = axis.first, to = axis.second;
  const double reach_mm = head.radius_mm + 0.5 * ct.grid.spacing_mm;
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(ct.grid.indexFromPoint(glm::min(from, to) - reach_mm))), 0);
  const glm::ivec3 end =
      glm::min(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(glm::max(from, to) + reach_mm))) + 1, ct.grid.size);
  std::vector<int> touched;
  assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    const int fdi = ct.tooth[v];
    if (fdi == 0 || ct.solid[v] < assets::kHalfSolid || std::ranges::find(touched, fdi) != touched.end()) return;
    if (calibration::distanceToSegment(ct.grid.centre_P_mm(ijk), from, to) <= reach_mm) touched.push_back(fdi);
  });
  return touched;
}

std::vector<Touch> Touches::follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool) {
  std::vector<Touch> ended;
  for (const haptics::Tick& tick : ticks) {
    // A curette or an elevator is no bur, wherever it is held.
    if (tool.turns()) lookAt(tick, tool);
    if (running_.empty()) continue;
    const std::vector<Touch> over = endedBefore(tick.t_s - kTouchPause_s);
    ended.insert(ended.end(), over.begin(), over.end());
  }
  return ended;
}

void Touches::lookAt(const haptics::Tick& tick, const haptics::Tool& tool) {
  for (const int fdi : teethTouched(tick, tool.head, patient_)) touch(assets::toothName(fdi), tick);
  // Only what lies in bone can reach the canal.
  if (tick.depth_mm > 0.0 && !canal_.isEmpty() && haptics::clearance_mm(canal_, tool, heldPose(tick)) <= 0.0)
    touch(kCanalTouch, tick);
}

std::vector<Touch> Touches::finish() { return endedBefore(std::numeric_limits<double>::infinity()); }

std::vector<Touch> Touches::endedBefore(double time_s) {
  std::vector<Touch> ended;
  std::erase_if(running_, [&](const auto& entry) {
    const auto& [what, running] = entry;
    if (running.last_s >= time_s) return false;
    ended.push_back({what, running.contact_s});
    return true;
  });
  for (const Touch& touch : ended) countInto(counts_, touch);
  return ended;
}

}  // namespace app
