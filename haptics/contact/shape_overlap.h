// Overlap of a head of any shape and pose with the bone: sums over voxels, each weighted by its solid fraction and the
// part covered by the head (bone/bur_coverage). Frame P, mm. Any thread that may read the field; no allocation. Blocks
// of 4^3 voxels outside the head are skipped, those inside use their sums, the others are summed 64 voxels at a time
// (bone/head_kernels); the same bits on every machine, within 1e-6 of the sum voxel by voxel. Cost grows with the
// surface: 50 us for a fissure bur of 1.6 x 4 mm at 0.1 mm, 10 us at 0.2 mm. Spheres: contact/overlap is faster, but
// has no area.
#pragma once

#include "haptics/body/solid_bodies.h"
#include "haptics/contact/contact.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

struct ShapeOverlap {
  double volume_mm3 = 0.0;
  calibration::Vector<calibration::Patient> first_moment_P_mm4;  ///< about T's origin
  /// The bone's surface inside the head as an area vector out of the bone: -grad V over the tool's position by
  /// differences of one voxel each way, [V(c - s e) - V(c + s e)] / 2s. Exact for a flat face and a convex head.
  calibration::Vector<calibration::Patient> area_P_mm2;
  double stiff_mm3 = 0.0;  ///< the volume, each voxel times its tissue's stiffness factor
  double grey_mm3 = 0.0;   ///< the volume, each voxel times 1 - w: softness of the face, see equivalentDepth_mm
};

/// Zero for an invalid shape or pose.
ShapeOverlap shapeOverlap(const SolidField& field, const BurShape& shape,
                          const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                          const TissueStiffness& tissue) noexcept;

/// The sum over several bodies.
ShapeOverlap shapeOverlap(const SolidBodies& bodies, const BurShape& shape,
                          const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                          const TissueStiffness& tissue) noexcept;

}  // namespace haptics
