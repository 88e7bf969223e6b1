#include "haptics/contact/shell.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/field_sample.h"
#include "haptics/contact/immersion.h"
#include "haptics/contact/surface_points.h"

namespace haptics {
namespace {

/// Slope in flat bone; for heads that are no balls the secant.
double slope_N_per_mm(const ShellParameters& parameters, const ToolInBone& at, const Immersion& immersion,
                      double force_N) {
  if (at.head.kind == ShapeKind::sphere)
    return std::max(0.0,
                    2.0 * calibration::kPi * parameters.shell_N_per_mm3 * (at.head.radius_mm - immersion.depth_mm));
  return force_N / std::max(immersion.depth_mm, at.bodies.spacing_mm());
}

}  // namespace

Contact shellContact(const ShellParameters& parameters, const ToolInBone& at) noexcept {
  const Immersion immersion = immersionOf(at);
  Contact contact = contactAlongNormal(immersion, 0.0, 0.0);
  if (immersion.volume_mm3 <= 0.0) return contact;

  // The pressure on each point's patch, in T.
  const HeadProfile profile(at.head);
  const ToolSampler sampler(at.bodies, at.X_PT);
  glm::dvec3 force(0.0), torque(0.0);
  double pressed = 0.0, bare = 0.0;
  visitSurfacePoints(profile, kShellPoints, [&](const glm::dvec3& position_T, const glm::dvec3& normal_T) {
    const FieldSample sample = sampler.at(position_T);
    if (sample.solid <= 0.0) return;
    const double pressure =
        sample.solid * at.tissue.factor[std::min<std::size_t>(sample.label, assets::kTissueCount - 1)];
    bare += sample.solid;
    pressed += pressure;
    force -= pressure * normal_T;
    torque -= pressure * glm::cross(position_T, normal_T);
  });
  if (bare <= 0.0) return contact;
  const double per_point_N = parameters.shell_N_per_mm3 * profile.area_mm2() / kShellPoints;
  contact.force_P_N.xyz = per_point_N * (at.X_PT.rotation * force);
  contact.torque_P_Nmm.xyz = per_point_N * (at.X_PT.rotation * torque);
  contact.tissue_factor = pressed / bare;
  const double flat_N = glm::length(contact.force_P_N.xyz) / std::max(1e-12, contact.tissue_factor);
  contact.stiffness_N_per_mm = contact.tissue_factor * slope_N_per_mm(parameters, at, immersion, flat_N);
  return contact;
}

}  // namespace haptics
