#include "haptics/contact/law.h"

#include <algorithm>

#include "haptics/contact/cap.h"

namespace haptics {

Contact contactOf(const LawSettings& law, const ToolInBone& at) noexcept {
  if (!admits(law.kind, at.head.kind)) return {};
  const AgusContact agus = agusContact(at.field, {at.X_PT.translation_mm}, at.head.radius_mm);
  Contact contact;
  contact.force_P_N = law.agus.stiffness_N_per_mm * agus.depth_mm * agus.normal_P;
  contact.normal_P = agus.normal_P;
  contact.depth_mm = agus.depth_mm;
  contact.stiffness_N_per_mm = law.agus.stiffness_N_per_mm;
  contact.volume_mm3 = agus.volume_mm3;
  const double flat_mm4 = capMoment_mm4(at.head.radius_mm, agus.depth_mm);
  contact.one_sided = flat_mm4 > 0.0 ? agus.moment_mm4 / flat_mm4 : 1.0;
  return contact;
}

calibration::Vector<calibration::Patient> dampingForce_N(
    const LawSettings& law, const Contact& contact,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept {
  if (contact.depth_mm <= 0.0) return {};
  return -std::max(0.0, law.damping_Ns_per_mm) * velocity_P_mm_per_s;
}

}  // namespace haptics
