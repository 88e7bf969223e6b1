// The force laws of the field behind one call: which one, and with which parameters, is a value that may change from
// tick to tick. Every law is a file of its own in contact/. Servo thread; costs as the laws say. No allocation, no
// throw; a law answers a zero Contact where it does not admit the shape.
#pragma once

#include "haptics/contact/law_settings.h"
#include "haptics/contact/law_state.h"

namespace haptics {

/// As a law with this memory answers; it is only read, so a proxy may look as often as it likes.
Contact contactOf(const LawSettings& law, const ToolInBone& at, const LawState& state) noexcept;
/// A law that remembers nothing.
Contact contactOf(const LawSettings& law, const ToolInBone& at) noexcept;

/// Takes in the last look of a tick. Out of contact nothing is remembered but that a hold is over.
void updateLawState(const LawSettings& law, const ToolInBone& at, const Contact& contact, LawState& state) noexcept;

/// The part of the force that takes energy from the moving hand: -b v while in contact, every law's.
calibration::Vector<calibration::Patient> dampingForce_N(
    const LawSettings& law, const Contact& contact,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept;

}  // namespace haptics
