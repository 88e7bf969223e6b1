// Inputs of an erosion law and of the motor for a bur in bone: contact and pose as the plain values of
// bone/erosion_step. Servo thread; under a microsecond, with erosion `machining` an overlap sum and about 600 samples
// of the field more. Frame P; mm, N, s.
#pragma once

#include "haptics/bone/erosion_step.h"
#include "haptics/contact/contact.h"
#include "haptics/tool/spindle.h"

namespace haptics {

/// `contact` of the head at `at`; `at.motion.velocity` is the feed; `normal_force_N` presses the bur on the bone.
CutConditions cutConditions(const ErosionSettings& erosion, const SpindleSettings& spindle, const ToolInBone& at,
                            const Contact& contact, double normal_force_N) noexcept;

/// Load torque of the spindle, N mm: friction mu F_n times the sliding arm, or the force law's spindle torque
/// (contact/machining) if larger.
double spindleLoad_Nmm(const ErosionSettings& erosion, const CutConditions& conditions, double law_torque_Nmm) noexcept;

}  // namespace haptics
