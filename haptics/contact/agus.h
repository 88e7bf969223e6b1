// Agus's contact: the force of bone on a spherical bur from the volume they share and where it lies (Agus et al., IEEE
// VR 2002; Presence 12(1), 2003; reference/physics 1.1). Frame P; mm, N, s; the force acts on the hand.
//   n = -M1 / |M1|,  h from V = pi h^2 (R - h/3) less the voxel bias,  F = k h n.
// The raw law: no proxy (servo/proxy), no limits (safety/safety_filter). One overlap sum a call. Any thread.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/contact/overlap.h"

namespace haptics {

struct AgusParameters {
  double stiffness_N_per_mm = 0.8;  ///< F = k h; 0.8 N/mm feels hard at 1 kHz and stays passive (reference/physics 6)
};

struct AgusContact {
  double volume_mm3 = 0.0;
  double stiff_mm3 = 0.0;                              ///< volume times stiffness factor of its tissue
  double moment_mm4 = 0.0;                             ///< |M1|
  double depth_mm = 0.0;                               ///< equivalent depth in flat bone, 0..2R; 0: no contact
  calibration::Vector<calibration::Patient> normal_P;  ///< out of the bone; shorter than 1 where bone is on all sides
};

AgusContact agusContact(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                        double radius_mm) noexcept;
AgusContact agusContact(const SolidField& field, const calibration::Point<calibration::Patient>& centre_P,
                        double radius_mm, const TissueStiffness& tissue) noexcept;

/// The law: k h n, weighted by tissue. Any shape.
Contact agusLaw(const AgusParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
