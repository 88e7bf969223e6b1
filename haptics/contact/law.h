// The force laws of the field behind one call: which one, and with which parameters, is a value that may change from
// tick to tick. Every law is a file of its own in contact/. Servo thread; costs as the laws say. No allocation, no
// throw; a law answers a zero Contact where it does not admit the shape.
#pragma once

#include "haptics/contact/law_settings.h"

namespace haptics {

Contact contactOf(const LawSettings& law, const ToolInBone& at) noexcept;

/// The part of the force that takes energy from the moving hand: -b v while in contact, every law's.
calibration::Vector<calibration::Patient> dampingForce_N(
    const LawSettings& law, const Contact& contact,
    const calibration::Vector<calibration::Patient>& velocity_P_mm_per_s) noexcept;

}  // namespace haptics
