#include "haptics/contact/law.h"

#include "haptics/contact/cap.h"

namespace haptics {

Contact contactOf(const LawSettings& law, const ToolInBone& at) noexcept {
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

}  // namespace haptics
