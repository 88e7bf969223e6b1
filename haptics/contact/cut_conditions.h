// What an erosion law and the motor are told of a bur in bone: contact and pose as the plain numbers of
// bone/erosion_step. Servo thread; under a microsecond, but for the erosion `machining` an overlap sum and some 600
// samples of the field. Frame P; mm, N, s.
#pragma once

#include "haptics/bone/erosion_step.h"
#include "haptics/contact/contact.h"
#include "haptics/tool/spindle.h"

namespace haptics {

/// `contact` of the head at `at`; `at.motion.velocity` is the feed. `normal_force_N` is what presses the bur on.
CutConditions cutConditions(const ErosionSettings& erosion, const SpindleSettings& spindle, const ToolInBone& at,
                            const Contact& contact, double normal_force_N) noexcept;

/// What holds the spindle back, N mm: friction mu F_n times the sliding arm, or what the force law knows of it
/// (contact/machining) if that is more.
double spindleLoad_Nmm(const ErosionSettings& erosion, const CutConditions& moment, double law_torque_Nmm) noexcept;

}  // namespace haptics
