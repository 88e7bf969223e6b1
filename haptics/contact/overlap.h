// Overlap of a spherical bur and the bone: volume and first moment, summed over voxels as spheres of equal volume (Agus
// et al. 2002; reference/physics 1.1, 2.3, 2.6), each weighted by its solid fraction. Frame P, mm. Any thread that may
// read the field; no allocation. Outside the volume is air. Cost ~ (R/s)^2 (haptics/README): blocks inside by their
// sums, the shell sixteen voxels at a time (bone/cubelets, bone/lens_curve), by the fastest instruction set of the
// machine: AVX-512 and AVX2 give the same bits, portable agrees to 1e-6. Forces: the laws of contact/law.
#pragma once

#include <cstdint>

#include "assets/instruction_set.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/body/solid_bodies.h"
#include "haptics/contact/contact.h"

namespace haptics {

struct SphereOverlap {
  double volume_mm3 = 0.0;
  calibration::Vector<calibration::Patient> first_moment_P_mm4;  ///< about the bur's centre
  double grey_mm3 = 0.0;   ///< sum of overlap times w (1 - w): softness of the face, see equivalentDepth_mm
  double stiff_mm3 = 0.0;  ///< sum of overlap times the stiffness factor of its tissue
};

/// Zero for a non-finite centre or radius. Without `tissue` every factor is 1. `set` must be available (assert).
SphereOverlap sphereOverlap(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm, const TissueStiffness* tissue = nullptr,
                            assets::InstructionSet set = assets::chosenInstructionSet()) noexcept;

/// The sum over several bodies.
SphereOverlap sphereOverlap(const SolidBodies& bodies, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm, const TissueStiffness* tissue = nullptr) noexcept;

/// The same sum voxel by voxel in double: for burs of less than three voxels' radius, tests and benchmarks.
SphereOverlap sphereOverlapVoxelByVoxel(const SolidField& field,
                                        const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                                        const TissueStiffness* tissue = nullptr) noexcept;

/// The label with the largest part of the bur, from 192 samples; 0 without bone.
std::uint8_t dominantLabel(const SolidBodies& bodies, const calibration::Point<calibration::Patient>& centre_P,
                           double radius_mm) noexcept;

}  // namespace haptics
