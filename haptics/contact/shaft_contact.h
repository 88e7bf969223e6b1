// The shaft against the bone: felt, but never cutting. A rod with round ends from the head's top to the shaft's length,
// one overlap sum (contact/shape_overlap), almost free in air. Frame P; mm, N, N mm. Servo thread.
//   n = A / |A|;   F = k f h n at the centroid of the shared part, f the mean tissue factor
// The depth does not come from the volume alone, since on an edge only a short part of the rod overlaps. A rod on its
// side overlaps V ~ h^(3/2) per length, so h = 3/2 V/A for any length, with V = M/(r - 0.4 h) of the moment M about the
// rod's axis. The voxels' smear sigma = 0.4 s biases the quotient q; corrected, h = q - q0 (q0/q)^(3/2), q0 = 1.046
// sigma:  0 at first touch, slope 1 there, within 5 % of sigma everywhere. Up to a third too shallow across an edge.
// Fades between facing walls.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/tool/tool.h"

namespace haptics {

/// Zero without a shaft, or if the head covers it.
Contact shaftContact(const SolidBodies& bodies, const Tool& tool,
                     const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                     const TissueStiffness& tissue, double stiffness_N_per_mm) noexcept;

}  // namespace haptics
