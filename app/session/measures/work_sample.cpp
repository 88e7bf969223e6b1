#include "app/session/measures/work_sample.h"

#include <algorithm>

#include "app/session/measures/original_surface.h"

namespace app {

WorkSample workSample(const haptics::Tick& tick, const haptics::Command& in_force, const OriginalSurface* surface) {
  WorkSample sample;
  sample.t_s = tick.t_s;
  sample.dt_s = tick.dt_s;
  sample.bur_P_mm = tick.proxy_P.mm;
  sample.axis_P = tick.heldRotation() * glm::dvec3(0.0, 0.0, 1.0);
  sample.velocity_P_mm_per_s = tick.hand.velocity_P_mm_per_s.xyz;
  sample.force_P_N = tick.law_force_P_N.xyz;
  sample.radius_mm = in_force.tool.head.radius_mm;
  sample.removed_mm3 = std::max(0.0, tick.removed_mm3);
  sample.turns = tick.drilling;
  sample.touches = tick.overlap_mm3 > 0.0;
  sample.irrigated = in_force.irrigating;
  sample.valid = !has(tick.faults, haptics::Fault::bad_pose);
  if (surface != nullptr && sample.drills()) sample.normal_P = surface->normalAt(sample.bur_P_mm);
  return sample;
}

}  // namespace app
