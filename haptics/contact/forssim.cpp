#include "haptics/contact/forssim.h"

#include <algorithm>

#include "haptics/contact/cap.h"
#include "haptics/contact/immersion.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

/// A hold does not end farther than this from its end point.
constexpr double kHoldReach_mm = 2.0;

calibration::Point<calibration::Patient> originOf(const ToolInBone& at) { return {at.X_PT.translation_mm}; }

}  // namespace

Contact forssimContact(const ForssimParameters& parameters, const ToolInBone& at, const LawState& state) noexcept {
  const Immersion immersion = immersionOf(at);
  const double R = at.head.radius_mm, per_mm3 = parameters.force_constant_N / (R * R * R);
  // The volume free of the voxels' bias.
  const double flat_mm3 =
      at.head.kind == ShapeKind::sphere
          ? capVolume_mm3(R, immersion.depth_mm)
          : flatOverlap(at.head, immersion.depth_mm, axisCosine(at, immersion.normal_P.xyz)).volume_mm3;
  Contact contact = contactAlongNormal(immersion, per_mm3 * flat_mm3, per_mm3 * immersion.face_mm2);
  if (!state.holding || parameters.hold_N_per_mm <= 0.0) return contact;
  contact.force_P_N = parameters.hold_N_per_mm * (state.held_P - originOf(at));
  contact.torque_P_Nmm = {};
  contact.stiffness_N_per_mm = parameters.hold_N_per_mm;
  return contact;
}

void updateForssimState(const ForssimParameters& parameters, const ToolInBone& at, const Contact& contact,
                        LawState& state) noexcept {
  const double immersed = contact.volume_mm3 / volume_mm3(at.head);
  if (parameters.hold_N_per_mm <= 0.0 || contact.depth_mm <= 0.0) {
    state.holding = false;
  } else if (!state.holding) {
    state.holding = immersed > parameters.hold_from;
    state.held_P = originOf(at) + (1.0 / parameters.hold_N_per_mm) * contact.force_P_N;
  } else {
    const double away_mm = glm::length((state.held_P - originOf(at)).xyz);
    state.holding = away_mm >= kHoldReach_mm || immersed >= std::min(parameters.hold_until, parameters.hold_from);
  }
}

}  // namespace haptics
