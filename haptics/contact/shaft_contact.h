// The shaft against the bone: felt, and never cutting. A rod with round ends from the head's top to the shaft's length,
// one overlap sum (contact/shape_overlap); next to nothing in air. Frame P; mm, N, N mm. Servo thread.
//   n = A / |A|;   F = k f h n through the middle of what is shared, f the mean tissue factor
// Only part of a rod lies on an edge of bone, so its depth can not come from the volume alone, as if all of it lay on
// flat bone. A rod on its side shares V ~ h^(3/2) per length whatever the length, so h = 3/2 V/A, with V = M/(r - 0.4
// h) of the moment M about the rod's axis. Of the voxels' smear sigma = 0.4 s the quotient q keeps
//   h = q - q0 (q0/q)^(3/2), q0 = 1.046 sigma: 0 at the first touch, slope 1 there, within 5 % of sigma everywhere.
// Across an edge this is up to a third too shallow. Between facing walls the force fades, as the head's does.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// Zero without a shaft, or where it does not reach out of the head.
Contact shaftContact(const SolidField& field, const Tool& tool,
                     const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                     const TissueStiffness& tissue, double stiffness_N_per_mm) noexcept;

}  // namespace haptics
