#include "haptics/contact/shaft_contact.h"

#include <algorithm>
#include <cmath>

#include "haptics/contact/shape_overlap.h"

namespace haptics {
namespace {

/// Depth of a rod on bone from the moment of the shared part about its axis and the surface inside it. Between facing
/// walls both cancel alike, so the quotient is that of one wall.
double lyingDepth_mm(double moment_mm4, double area_mm2, double radius_mm, double spacing_mm) {
  if (!(area_mm2 > 0.0)) return 0.0;
  const double q0 = 1.046 * 0.4 * spacing_mm;
  double h = 0.0;
  // The moment arm of a shallow segment is r - 0.4 h.
  for (int i = 0; i < 3; ++i) {
    const double q = 1.5 * moment_mm4 / (area_mm2 * (radius_mm - 0.4 * h)), part = q0 / q;
    if (q <= q0) return 0.0;
    h = std::min(q - q0 * part * std::sqrt(part), radius_mm);
  }
  return h;
}

}  // namespace

Contact shaftContact(const SolidBodies& bodies, const Tool& tool,
                     const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                     const TissueStiffness& tissue, double stiffness_N_per_mm) noexcept {
  // The rod with its round ends reaches from the head's top to the shaft's end.
  const double r = tool.shaft.radius_mm, top = halfHeight_mm(tool.head);
  const double core = tool.shaft.length_mm - top - 2.0 * r;
  if (!(r > 0.0) || !(core >= 0.0)) return {};
  const double middle = top + r + 0.5 * core;
  const glm::dvec3 axis_P = X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const ShapeOverlap overlap = shapeOverlap(bodies, {ShapeKind::capsule, r, core},
                                            {X_PT.rotation, X_PT.translation_mm + middle * axis_P}, tissue);
  Contact contact;
  contact.volume_mm3 = overlap.volume_mm3;
  if (!(overlap.volume_mm3 > 0.0)) return contact;
  const glm::dvec3 centroid = overlap.first_moment_P_mm4.xyz / overlap.volume_mm3;
  const double off_axis_mm = glm::length(centroid - glm::dot(centroid, axis_P) * axis_P);
  const double area_mm2 = glm::length(overlap.area_P_mm2.xyz);
  contact.depth_mm = lyingDepth_mm(off_axis_mm * overlap.volume_mm3, area_mm2, r, bodies.spacing_mm());
  if (contact.depth_mm <= 0.0) return contact;

  contact.one_sided = std::min(1.0, off_axis_mm / (r - 0.4 * contact.depth_mm));
  contact.normal_P.xyz = overlap.area_P_mm2.xyz / area_mm2 * std::min(1.0, contact.one_sided / 0.6);
  contact.stiffness_N_per_mm = stiffness_N_per_mm * overlap.stiff_mm3 / overlap.volume_mm3;
  contact.force_P_N = contact.stiffness_N_per_mm * contact.depth_mm * contact.normal_P;
  contact.torque_P_Nmm.xyz = glm::cross(centroid + middle * axis_P, contact.force_P_N.xyz);
  return contact;
}

}  // namespace haptics
