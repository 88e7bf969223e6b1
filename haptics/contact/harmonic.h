// The harmonic law: bone at distance r < R from the bur's centre repels it like a charge, U = sum rho k / (2 pi r)
// (reference/physics 2.7, 2.8). On flat bone F = k h exactly in any orientation for 0 <= h <= R; the force is the
// gradient of a potential, so no closed path gives energy to the hand. Spheres only. Frame P; mm, N. Servo thread. A
// voxel acts as a ball of radius 1.2295 edges, where the transform of a ball has its second zero at the lattice's first
// frequency: little ripple, no bias where F is linear; first touch is felt 0.23 s deep. Blocks far inside act from
// their centre of mass. Cost ~ (R/s)^2, besides one overlap sum for depth, normal and volume.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct HarmonicParameters {
  double stiffness_N_per_mm = 0.8;  ///< k of cortical bone: dF/dh from first touch to h = R
};

/// Radius of a voxel's ball in voxels: the second root of tan q = q, 7.72525, over 2 pi.
inline constexpr double kVoxelChargeRadius = 1.22951199;

/// Force, in units of k times length, between a bur of radius R and a ball of density 1 and radius B at distance `d`.
double harmonicForceOfBall(double R, double B, double d) noexcept;

/// The sum over voxels for k = 1, weighted by tissue; N per N/mm, that is mm.
calibration::Vector<calibration::Patient> harmonicForce_mm(const ToolInBone& at) noexcept;
/// The same voxel by voxel in double: for small burs and tests.
calibration::Vector<calibration::Patient> harmonicForceVoxelByVoxel_mm(const ToolInBone& at) noexcept;

Contact harmonicContact(const HarmonicParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
