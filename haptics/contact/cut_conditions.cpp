#include "haptics/contact/cut_conditions.h"

#include <algorithm>
#include <cmath>

#include "haptics/contact/machining.h"
#include "haptics/contact/sliding.h"

namespace haptics {

CutConditions cutConditions(const ErosionSettings& erosion, const SpindleSettings& spindle, const ToolInBone& at,
                            const Contact& contact, double normal_force_N) noexcept {
  CutConditions conditions;
  conditions.dt_s = at.motion.dt_s;
  conditions.spindle_rad_per_s = at.motion.spindle_rad_per_s;
  conditions.axis_P.xyz = at.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  conditions.overlap_mm3 = contact.volume_mm3;
  conditions.normal_force_N = std::max(0.0, normal_force_N);
  conditions.power_Nmm_per_s = availablePower_Nmm_per_s(spindle, at.motion.spindle_rad_per_s);
  const double length = glm::length(contact.normal_P.xyz);
  const double sine =
      length > 0.0 ? std::min(1.0, glm::length(glm::cross(contact.normal_P.xyz, conditions.axis_P.xyz)) / length) : 1.0;
  conditions.sliding_arm_mm = slidingArm_mm(at.head, contact.depth_mm, sine);
  if (erosion.kind == ErosionKind::machining) conditions.swept_mm3_per_s = sweptRate_mm3_per_s(at);
  return conditions;
}

double spindleLoad_Nmm(const ErosionSettings& erosion, const CutConditions& conditions,
                       double law_torque_Nmm) noexcept {
  const double friction_Nmm = erosion.friction * conditions.normal_force_N * conditions.sliding_arm_mm;
  const double load = std::max(friction_Nmm, law_torque_Nmm);
  return std::isfinite(load) ? std::max(0.0, load) : 0.0;
}

}  // namespace haptics
