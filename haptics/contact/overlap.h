// What a spherical bur shares with the bone: volume and first moment, summed over voxels taken as spheres of equal
// volume (Agus et al. 2002; reference/physics 1.1, 2.3, 2.6), each weighted by its solid fraction. Frame P, mm. Any
// thread that may read the field. No allocation; the same bits on every machine: integer sums inside, doubles in a
// fixed order in the shell. Cost ~ (R/s)^3/8 integer steps + 15.6 (R/s)^2 lenses; see README for figures. A voxel
// wholly inside counts whole; outside the volume is air. Not a force (contact/agus).
#pragma once

#include <cstdint>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

struct SphereOverlap {
  double volume_mm3 = 0.0;
  calibration::Vector<calibration::Patient> first_moment_P_mm4;  ///< about the bur's centre
  double grey_mm3 = 0.0;  ///< sum of overlap times w (1 - w): how much of it is transition, see equivalentDepth_mm
};

/// Zero for a non-finite centre or radius.
SphereOverlap sphereOverlap(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                            double radius_mm) noexcept;

/// The same sum, voxel by voxel in double: slow and obvious, the twin that tests and benchmarks compare with.
SphereOverlap sphereOverlapVoxelByVoxel(const SolidField& field,
                                        const calibration::Point<calibration::Patient>& centre_P, double radius_mm);

/// The label that fills most of the bur, from about a thousand samples on a sub-lattice; 0 where there is no bone.
std::uint8_t dominantLabel(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                           double radius_mm) noexcept;

}  // namespace haptics
