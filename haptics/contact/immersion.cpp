#include "haptics/contact/immersion.h"

#include "calibration/geometry/units.h"
#include "haptics/contact/agus.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/shape_contact.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

Immersion ofBall(const ToolInBone& at) {
  const double R = at.head.radius_mm;
  const AgusContact ball = agusContact(at.field, {at.X_PT.translation_mm}, R, at.tissue);
  Immersion immersion;
  immersion.volume_mm3 = ball.volume_mm3;
  immersion.depth_mm = ball.depth_mm;
  if (ball.depth_mm <= 0.0) return immersion;
  immersion.flat_volume_mm3 = capVolume_mm3(R, ball.depth_mm);
  immersion.face_mm2 = calibration::kPi * ball.depth_mm * (2.0 * R - ball.depth_mm);
  const double flat_mm4 = capMoment_mm4(R, ball.depth_mm);
  immersion.one_sided = flat_mm4 > 0.0 ? ball.moment_mm4 / flat_mm4 : 0.0;
  immersion.tissue_factor = ball.stiff_mm3 / ball.volume_mm3;
  immersion.normal_P = ball.normal_P;
  return immersion;
}

Immersion ofShape(const ToolInBone& at) {
  const ShapeContact shape = shapeContact(at);
  Immersion immersion;
  immersion.volume_mm3 = shape.volume_mm3;
  immersion.depth_mm = shape.depth_mm;
  if (shape.depth_mm <= 0.0) return immersion;
  const glm::dvec3 axis_P = at.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const double length = glm::length(shape.normal_P.xyz);
  const double cos_axis = length > 0.0 ? glm::dot(axis_P, shape.normal_P.xyz) / length : 0.0;
  immersion.flat_volume_mm3 = flatOverlap(at.head, shape.depth_mm, cos_axis).volume_mm3;
  immersion.face_mm2 = shape.area_mm2;
  immersion.one_sided = shape.one_sided;
  immersion.tissue_factor = shape.stiffness_factor;
  immersion.normal_P = shape.normal_P;
  immersion.arm_P_mm = shape.centroid_P_mm;
  return immersion;
}

}  // namespace

Immersion immersionOf(const ToolInBone& at) noexcept {
  Immersion immersion = at.head.kind == ShapeKind::sphere ? ofBall(at) : ofShape(at);
  // An unlabelled volume is all of one tissue.
  if (at.field.label == nullptr) immersion.tissue_factor = at.tissue.factor[0];
  return immersion;
}

Contact contactAlongNormal(const Immersion& immersion, double force_N, double slope_N_per_mm) noexcept {
  Contact contact;
  contact.volume_mm3 = immersion.volume_mm3;
  if (immersion.depth_mm <= 0.0) return contact;
  contact.force_P_N = immersion.tissue_factor * force_N * immersion.normal_P;
  contact.torque_P_Nmm.xyz = glm::cross(immersion.arm_P_mm.xyz, contact.force_P_N.xyz);
  contact.normal_P = immersion.normal_P;
  contact.depth_mm = immersion.depth_mm;
  contact.stiffness_N_per_mm = immersion.tissue_factor * slope_N_per_mm;
  contact.one_sided = immersion.one_sided;
  contact.tissue_factor = immersion.tissue_factor;
  return contact;
}

}  // namespace haptics
