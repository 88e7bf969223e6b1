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

CarveResult Cutting::cut(CarvedBone& bone, StrokeHistory& strokes, const ErosionSettings& erosion,
                         const SpindleSettings& spindle, const LawSettings& law, const Engagement& held, bool allowed,
                         double dt_s, std::uint64_t tick) noexcept {
  const calibration::Point<calibration::Patient> here_P{held.X_PQ.translation_mm};
  if (!(held.contact.volume_mm3 > 0.0)) {
    memory_ = {};
    load_Nmm_ = 0.0;
    was_in_bone_ = false;
    return {};
  }

  // The feed is the bur's own, not the hand's: a bur that the bone holds sweeps nothing.
  const SolidField field = bone.field();
  ToolMotion feed = motion({}, dt_s);
  if (was_in_bone_) feed.velocity_P_mm_per_s = (1.0 / dt_s) * (here_P - last_P_);
  last_P_ = here_P;
  was_in_bone_ = true;

  const ToolInBone at{field, held.head, held.X_PQ, law.tissue, feed};
  const double length = glm::length(held.contact.normal_P.xyz);
  const double pressing_N = length > 0.0 ? glm::dot(held.force_P_N.xyz, held.contact.normal_P.xyz) / length : 0.0;
  const CutConditions moment = cutConditions(erosion, spindle, at, held.contact, pressing_N);
  const double law_Nmm = law.kind == LawKind::machining ? spindleTorque_Nmm(held.contact, at) : 0.0;
  load_Nmm_ = spindleLoad_Nmm(erosion, moment, law_Nmm);
  if (!allowed) return {};

  const ErosionStep step = erosionStep(erosion, moment, memory_);
  CarveResult removed;
  if (!step.isZero())
    removed = carveTool(bone, held.head, held.X_PQ, step, tick, carveInterleave(bone, held.head, step), &strokes);
  memory_ = updatedErosion(erosion, moment, memory_, removed.removed_mm3_by_label);
  return removed;
}

}  // namespace haptics
