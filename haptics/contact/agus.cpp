#include "haptics/contact/agus.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/immersion.h"

namespace haptics {

namespace {

AgusContact contactFrom(const SphereOverlap& overlap, double radius_mm, double spacing_mm) {
  AgusContact contact;
  contact.volume_mm3 = overlap.volume_mm3;
  contact.stiff_mm3 = overlap.stiff_mm3;
  contact.moment_mm4 = glm::length(overlap.first_moment_P_mm4.xyz);
  contact.depth_mm = equivalentDepth_mm(radius_mm, overlap.volume_mm3, overlap.grey_mm3, spacing_mm);
  if (contact.depth_mm <= 0.0) return contact;

  // One percent of the largest moment a ball of this size, or a shell of this volume, can have: below it the direction
  // fades instead of turning at random (reference/physics 2.5d). A shallow touch, |M1| ~ R V, is not faded.
  const double largest =
      std::min(0.25 * calibration::kPi * radius_mm * radius_mm * radius_mm * radius_mm, radius_mm * overlap.volume_mm3);
  contact.normal_P.xyz = overlap.first_moment_P_mm4.xyz / -std::max(contact.moment_mm4, 0.01 * largest);
  return contact;
}

}  // namespace

AgusContact agusContact(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                        double radius_mm) noexcept {
  return contactFrom(sphereOverlap(field, centre_P, radius_mm), radius_mm, field.grid.spacing_mm);
}

AgusContact agusContact(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                        double radius_mm, const TissueStiffness& tissue) noexcept {
  return contactFrom(sphereOverlap(field, centre_P, radius_mm, tissue), radius_mm, field.grid.spacing_mm);
}

Contact agusLaw(const AgusParameters& parameters, const ToolInBone& at) noexcept {
  const Immersion immersion = immersionOf(at);
  return contactAlongNormal(immersion, parameters.stiffness_N_per_mm * immersion.depth_mm,
                            parameters.stiffness_N_per_mm);
}

}  // namespace haptics
