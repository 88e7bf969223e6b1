#include "haptics/contact/immersion.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/overlap.h"
#include "haptics/contact/shape_overlap.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

using calibration::kPi;

/// One percent of the largest moment a ball of this size, or a shell of this volume, can have: below it the direction
/// fades instead of turning at random (reference/physics 2.5d). A shallow touch, |M1| ~ R V, is not faded.
double largestMoment_mm4(double R, double volume_mm3) { return std::min(0.25 * kPi * R * R * R * R, R * volume_mm3); }

/// `vector` as a direction, shorter than 1 where it is less than a hundredth of `largest`.
calibration::Vector<calibration::Patient> direction(const glm::dvec3& vector, double largest) {
  const double length = std::max(glm::length(vector), 0.01 * largest);
  return {length > 0.0 ? vector / length : glm::dvec3(0.0)};
}

}  // namespace

double axisCosine(const ToolInBone& at, const glm::dvec3& normal_P) noexcept {
  const double length = glm::length(normal_P);
  return length > 0.0 ? glm::dot(at.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0), normal_P) / length : 0.0;
}

Immersion sphereImmersion(const SolidBodies& bodies, const calibration::Point<calibration::Patient>& centre_P,
                          double radius_mm, const TissueStiffness* tissue) noexcept {
  const SphereOverlap overlap = sphereOverlap(bodies, centre_P, radius_mm, tissue);
  Immersion immersion;
  immersion.volume_mm3 = overlap.volume_mm3;
  immersion.depth_mm = equivalentDepth_mm(radius_mm, overlap.volume_mm3, overlap.grey_mm3, bodies.spacing_mm());
  if (immersion.depth_mm <= 0.0) return immersion;
  const glm::dvec3& moment_mm4 = overlap.first_moment_P_mm4.xyz;
  const double found_mm4 = glm::length(moment_mm4), flat_mm4 = capMoment_mm4(radius_mm, immersion.depth_mm);
  immersion.face_mm2 = kPi * immersion.depth_mm * (2.0 * radius_mm - immersion.depth_mm);
  immersion.one_sided = flat_mm4 > 0.0 ? found_mm4 / flat_mm4 : 0.0;
  immersion.tissue_factor = overlap.stiff_mm3 / overlap.volume_mm3;
  immersion.normal_P.xyz = moment_mm4 / -std::max(found_mm4, 0.01 * largestMoment_mm4(radius_mm, overlap.volume_mm3));
  return immersion;
}

Immersion shapeImmersion(const ToolInBone& at) noexcept {
  const ShapeOverlap overlap = shapeOverlap(at.bodies, at.head, at.X_PT, at.tissue);
  Immersion immersion;
  immersion.volume_mm3 = overlap.volume_mm3;
  if (!(overlap.volume_mm3 > 0.0)) return immersion;

  // The direction first: the depth of a volume depends on the angle of the axis to the face.
  const double s = at.bodies.spacing_mm(), found_mm2 = glm::length(overlap.area_P_mm2.xyz);
  const double cos_axis = axisCosine(at, overlap.area_P_mm2.xyz);
  // V/A is half the depth of a round head.
  const double layers = found_mm2 > 0.0 ? 2.0 * overlap.volume_mm3 / (found_mm2 * s) : 0.0;
  const double sigma_mm = faceSmear_mm(found_mm2 > 0.0 ? overlap.grey_mm3 / found_mm2 : s / 6.0, layers, s);
  immersion.depth_mm = flatDepth_mm(at.head, overlap.volume_mm3, cos_axis, sigma_mm);
  if (immersion.depth_mm <= 0.0) return immersion;
  immersion.arm_P_mm.xyz = overlap.first_moment_P_mm4.xyz / overlap.volume_mm3;
  immersion.tissue_factor = overlap.stiff_mm3 / overlap.volume_mm3;

  // Nearly wholly immersed, the face of flat bone vanishes, and with it the reference.
  const double half_way_mm = 0.5 * fullDepth_mm(at.head, cos_axis);
  const double half_way_mm2 = flatOverlap(at.head, half_way_mm, cos_axis).area_mm2;
  immersion.face_mm2 = flatOverlap(at.head, immersion.depth_mm, cos_axis).area_mm2;
  const double least_mm2 = immersion.depth_mm > half_way_mm ? 0.05 * half_way_mm2 : 0.0;
  immersion.one_sided = std::min(1.0, found_mm2 / std::max({immersion.face_mm2, least_mm2, 1e-9}));
  immersion.normal_P =
      at.head.kind == ShapeKind::sphere
          ? direction(-overlap.first_moment_P_mm4.xyz, largestMoment_mm4(at.head.radius_mm, overlap.volume_mm3))
          : direction(overlap.area_P_mm2.xyz, std::min(half_way_mm2, immersion.face_mm2 + 0.05 * half_way_mm2));
  return immersion;
}

Immersion immersionOf(const ToolInBone& at) noexcept {
  Immersion immersion = at.head.kind == ShapeKind::sphere
                            ? sphereImmersion(at.bodies, {at.X_PT.translation_mm}, at.head.radius_mm, &at.tissue)
                            : shapeImmersion(at);
  // An unlabelled volume has one tissue.
  if (!at.bodies.isLabelled()) immersion.tissue_factor = at.tissue.factor[0];
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
