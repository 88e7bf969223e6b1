#include "haptics/contact/shape_contact.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/bone/voxel_sphere.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

/// How far the voxels smear depth, from how grey the face inside the head is (contact/cap).
double smear_mm(const ShapeOverlap& overlap, double area_mm2, double s) {
  const double found = area_mm2 > 0.0 ? std::clamp(overlap.grey_mm3 / area_mm2, 0.0, 0.25 * s) : s / 6.0;
  // A touch of less than a layer says nothing of the face's softness yet; V/A is half the depth of a round head.
  const double layers = area_mm2 > 0.0 ? 2.0 * overlap.volume_mm3 / (area_mm2 * s) : 0.0;
  const double known = std::clamp(layers - 0.5, 0.0, 1.0);
  const double softness = known * found + (1.0 - known) * s / 6.0;
  const double eta = kVoxelSphereRadius * s;
  return std::sqrt(std::max(eta * eta / 5.0 - s * s / 12.0 + s * softness, 1e-4 * s * s));
}

/// `vector` as a direction, shorter than 1 where it is less than a hundredth of the largest there can be.
calibration::Vector<calibration::Patient> direction(const glm::dvec3& vector, double largest) {
  const double length = std::max(glm::length(vector), 0.01 * largest);
  return {length > 0.0 ? vector / length : glm::dvec3(0.0)};
}

}  // namespace

ShapeContact shapeContact(const ToolInBone& at) noexcept {
  const ShapeOverlap overlap = shapeOverlap(at.field, at.head, at.X_PT, at.tissue);
  ShapeContact contact;
  contact.volume_mm3 = overlap.volume_mm3;
  if (!(overlap.volume_mm3 > 0.0)) return contact;
  contact.centroid_P_mm.xyz = overlap.first_moment_P_mm4.xyz / overlap.volume_mm3;
  contact.stiffness_factor = overlap.stiff_mm3 / overlap.volume_mm3;

  // The direction first: how deep a volume is hangs on the angle of the axis to the face.
  const bool round = at.head.kind == ShapeKind::sphere;
  const double found_mm2 = glm::length(overlap.area_P_mm2.xyz);
  const glm::dvec3 axis_P = at.X_PT.rotation * glm::dvec3(0.0, 0.0, 1.0);
  const double cos_axis = found_mm2 > 0.0 ? glm::dot(axis_P, overlap.area_P_mm2.xyz) / found_mm2 : 0.0;
  contact.depth_mm =
      flatDepth_mm(at.head, overlap.volume_mm3, cos_axis, smear_mm(overlap, found_mm2, at.field.grid.spacing_mm));
  if (contact.depth_mm <= 0.0) return contact;

  // Nearly wholly in, the face of flat bone vanishes and so does what is compared with it.
  const double half_way_mm = 0.5 * fullDepth_mm(at.head, cos_axis);
  const double half_way_mm2 = flatOverlap(at.head, half_way_mm, cos_axis).area_mm2;
  contact.area_mm2 = flatOverlap(at.head, contact.depth_mm, cos_axis).area_mm2;
  const double least_mm2 = contact.depth_mm > half_way_mm ? 0.05 * half_way_mm2 : 0.0;
  contact.one_sided = std::min(1.0, found_mm2 / std::max({contact.area_mm2, least_mm2, 1e-9}));
  const double R = at.head.radius_mm;
  // As contact/agus: the largest moment of a ball or of a thin touch; else a face through the head, or a thin touch.
  contact.normal_P =
      round ? direction(-overlap.first_moment_P_mm4.xyz,
                        std::min(0.25 * calibration::kPi * R * R * R * R, R * overlap.volume_mm3))
            : direction(overlap.area_P_mm2.xyz, std::min(half_way_mm2, contact.area_mm2 + 0.05 * half_way_mm2));
  return contact;
}

}  // namespace haptics
