// The force laws behind one call; law and parameters may change from tick to tick. Each law has its own file in
// contact/. Servo thread; costs as in the README; no allocation, no throw. A law returns a zero Contact for a shape it
// does not support.
#pragma once

#include "haptics/contact/law_settings.h"
#include "haptics/contact/law_state.h"

namespace haptics {

/// Reads `state` only, so that a proxy may evaluate several times a tick.
Contact contactOf(const LawSettings& law, const ToolInBone& at, const LawState& state = {}) noexcept;

/// From the last evaluation of a tick. Out of contact it only ends a hold.
void updateLawState(const LawSettings& law, const ToolInBone& at, const Contact& contact, LawState& state) noexcept;

/// -b v while in contact, for every law.
calibration::Vector<calibration::Patient> dampingForce_N(
    const LawSettings& law, const Contact& contact,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept;

}  // namespace haptics
