// How a cutting head lies in bone: shared volume, equivalent depth in flat bone, normal and point of action (Agus et
// al. 2002; reference/physics 1.1, 2.1-2.3). Frame P; mm. One overlap sum a call, and under 15 µs for heads that are no
// spheres. Servo thread (or any that may read the field). Not a force.
//   sphere:  n = -M1 / |M1| (contact/overlap),  h from V by contact/cap
//   others:  n = A / |A|, A the bone's surface inside the head (contact/shape_overlap),
//            h from V by the flat overlap at this angle (tool/flat_overlap), less the voxels' smear of contact/cap
// Where bone on all sides cancels out, n gets shorter than 1 instead of turning at random.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct Immersion {
  double volume_mm3 = 0.0;     ///< head and solid, as summed over voxels
  double depth_mm = 0.0;       ///< of flat bone, free of the voxels' bias, up to the whole head; 0: no contact
  double face_mm2 = 0.0;       ///< dV/ddepth of flat bone there
  double one_sided = 1.0;      ///< |M1| or |A| relative to flat bone of this depth: 0 in a slot
  double tissue_factor = 1.0;  ///< mean stiffness factor over the shared volume
  calibration::Vector<calibration::Patient> normal_P;  ///< out of the bone, at most 1 long
  calibration::Vector<calibration::Patient> arm_P_mm;  ///< from T's origin to the centroid; zero for a sphere
};

/// By head shape, with tissue; the one for laws.
Immersion immersionOf(const ToolInBone& at) noexcept;

/// Of a sphere; without `tissue` every factor is 1, which is cheaper.
Immersion sphereImmersion(const SolidBodies& bodies, const calibration::Point<calibration::Patient>& centre_P,
                          double radius_mm, const TissueStiffness* tissue = nullptr) noexcept;
/// Of any head by the bone's surface inside it.
Immersion shapeImmersion(const ToolInBone& at) noexcept;

/// Cosine between the head's axis and the normal; 0 without a normal.
double axisCosine(const ToolInBone& at, const glm::dvec3& normal_P) noexcept;

/// Contact of a law that pushes `force_N` along the normal with this slope. Applies the tissue factor.
Contact contactAlongNormal(const Immersion& immersion, double force_N, double slope_N_per_mm) noexcept;

}  // namespace haptics
