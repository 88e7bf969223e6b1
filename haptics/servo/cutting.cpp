#include "haptics/servo/cutting.h"

#include <algorithm>

#include "haptics/contact/machining.h"

namespace haptics {

void Cutting::turn(const SpindleSettings& spindle, bool pedal, double dt_s) noexcept {
  spindle_ = advanced(spindle, spindle_, pedal, load_Nmm_, dt_s);
}

ToolMotion Cutting::motion(const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s,
                           double dt_s) const noexcept {
  return {velocity_P_mm_per_s, spindle_.rad_per_s, dt_s, spindle_.vibration_phase_rad};
}

CarveResult Cutting::cut(Bodies& bodies, StrokeHistory& strokes, const ErosionSettings& erosion,
                         const SpindleSettings& spindle, const LawSettings& law, const Engagement& engaged,
                         bool allowed, double dt_s, std::uint64_t tick) noexcept {
  const calibration::Point<calibration::Patient> here_P{engaged.X_PT.translation_mm};
  if (!(engaged.contact.volume_mm3 > 0.0)) {
    erosion_state_ = {};
    load_Nmm_ = 0.0;
    was_in_bone_ = false;
    return {};
  }

  // The feed of the proxy, not of the hand: a bur held by the bone sweeps nothing.
  ToolMotion feed = motion({}, dt_s);
  if (was_in_bone_) feed.velocity_P_mm_per_s = (1.0 / dt_s) * (here_P - last_P_);
  last_P_ = here_P;
  was_in_bone_ = true;

  const ToolInBone at{bodies.view(), engaged.head, engaged.X_PT, law.tissue, feed};
  const double length = glm::length(engaged.contact.normal_P.xyz);
  const double pressing_N = length > 0.0 ? glm::dot(engaged.force_P_N.xyz, engaged.contact.normal_P.xyz) / length : 0.0;
  const CutConditions conditions = cutConditions(erosion, spindle, at, engaged.contact, pressing_N);
  const double law_Nmm = law.kind == LawKind::machining ? spindleTorque_Nmm(engaged.contact, at) : 0.0;
  load_Nmm_ = spindleLoad_Nmm(erosion, conditions, law_Nmm);
  if (!allowed) return {};

  const ErosionStep step = erosionStep(erosion, conditions, erosion_state_);
  CarveResult removed;
  if (!step.isZero())
    removed = carveTool(bodies, engaged.head, engaged.X_PT, step, tick,
                        carveInterleave(bodies.jaw(), engaged.head, step), &strokes);
  erosion_state_ = updatedErosion(erosion, conditions, erosion_state_, removed.removed_mm3_by_label);
  return removed;
}

}  // namespace haptics
