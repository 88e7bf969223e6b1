// What a spherical bur shares with the bone: volume and first moment, summed over voxels taken as spheres of equal
// volume (Agus et al. 2002; reference/physics 1.1, 2.3, 2.6), each weighted by its solid fraction. Frame P, mm. Any
// thread that may read the field. No allocation. A voxel wholly inside counts whole; outside the volume is air.
// Cost ~ (R/s)^2: blocks inside by their sums, the shell sixteen voxels at a time (bone/cubelets, bone/lens_curve); see
// README for figures. The fastest instruction set the machine has is taken: AVX-512 and AVX2 give the same bits, the
// portable kind agrees to 1e-6. Not a force (contact/agus …).
#pragma once

#include <cstdint>

#include "assets/instruction_set.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/solid_field.h"
#include "haptics/contact/contact.h"

namespace haptics {

struct SphereOverlap {
  double volume_mm3 = 0.0;
  calibration::Vector<calibration::Patient> first_moment_P_mm4;  ///< about the bur's centre
  double grey_mm3 = 0.0;   ///< sum of overlap times w (1 - w): how much of it is transition, see equivalentDepth_mm
  double stiff_mm3 = 0.0;  ///< sum of overlap times the stiffness factor of its tissue
};

/// Zero for a non-finite centre or radius. Without a tissue table every factor is 1.
SphereOverlap sphereOverlap(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm) noexcept;
SphereOverlap sphereOverlap(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm, const TissueStiffness& tissue) noexcept;
/// By one instruction set, which must be available (assert); null: no tissue table.
SphereOverlap sphereOverlapBy(assets::InstructionSet set, const SolidField& field,
                              const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                              const TissueStiffness* tissue) noexcept;

/// The same sum, voxel by voxel in double: slow and obvious, the twin that tests and benchmarks compare with, and the
/// way for burs of less than three voxels' radius.
SphereOverlap sphereOverlapVoxelByVoxel(const SolidField& field,
                                        const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                                        const TissueStiffness* tissue = nullptr) noexcept;

/// The label that fills most of the bur, from some hundred samples; 0 where there is no bone.
std::uint8_t dominantLabel(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                           double radius_mm) noexcept;

}  // namespace haptics
