#include "haptics/contact/law.h"

#include <algorithm>

#include "haptics/contact/immersion.h"

namespace haptics {

Contact contactOf(const LawSettings& law, const ToolInBone& at, const LawState& state) noexcept {
  if (!supports(law.kind, at.head.kind)) return {};
  switch (law.kind) {
    case LawKind::agus:
      return agusContact(law.agus, at);
    case LawKind::forssim:
      return forssimContact(law.forssim, at, state);
    case LawKind::hertz:
      return hertzContact(law.hertz, at);
    case LawKind::shell:
      return shellContact(law.shell, at);
    case LawKind::points:
      return pointsContact(law.points, at, state);
    case LawKind::machining:
      return machiningContact(law.machining, at);
    case LawKind::harmonic:
      return harmonicContact(law.harmonic, at);
  }
  return {};
}

void updateLawState(const LawSettings& law, const ToolInBone& at, const Contact& contact, LawState& state) noexcept {
  if (law.kind == LawKind::forssim) updateForssimState(law.forssim, at, contact, state);
  if (law.kind == LawKind::points) updatePointsState(contact, state);
}

calibration::Vector<calibration::Patient> dampingForce_N(
    const LawSettings& law, const Contact& contact,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept {
  if (contact.depth_mm <= 0.0) return {};
  return -std::max(0.0, law.damping_Ns_per_mm) * velocity_P_mm_per_s;
}

}  // namespace haptics
