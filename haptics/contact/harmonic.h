// The harmonic bur: bone at distance r < R from the bur's centre repels it as a charge does, U = sum rho k / (2 pi r)
// (reference/physics 2.7, 2.8). Flat bone then gives F = k h exactly in any orientation for 0 <= h <= R, and the force
// is the gradient of a potential: no closed path gives energy to the hand. Spheres only. Frame P; mm, N. Servo thread.
// A voxel acts as a ball, so inside the bur it is a point charge, exactly (Newton), and across the surface it has a
// closed form. The ball is wider than the voxel, 1.2295 edges, where the transform of a ball has its second zero at the
// lattice's first frequency: the lattice is hardly felt, and a smear costs no bias where F is linear. First touch is
// felt as if 0.23 s deep. Whole blocks far inside act from their centre of mass. Cost ~ (R/s)^2 besides one overlap
// sum, which gives depth, normal and volume.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct HarmonicParameters {
  double stiffness_N_per_mm = 0.8;  ///< k of cortical bone: dF/dh from first touch to h = R
};

/// Radius of a voxel's ball in voxels: the second root of tan q = q, 7.72525, over 2 pi.
inline constexpr double kVoxelChargeRadius = 1.22951199;

/// Force, in units of k times length, between a bur of radius R and a ball of density 1 and radius B, `d` apart.
double harmonicForceOfBall(double R, double B, double d) noexcept;

/// The sum over voxels, k = 1: N per N/mm, that is mm. Weighted by tissue.
calibration::Vector<calibration::Patient> harmonicForce_mm(const ToolInBone& at) noexcept;
/// The same voxel by voxel in double, without far blocks: the slow and obvious twin.
calibration::Vector<calibration::Patient> harmonicForceVoxelByVoxel_mm(const ToolInBone& at) noexcept;

Contact harmonicContact(const HarmonicParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
