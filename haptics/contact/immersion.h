// How a cutting head lies in bone, for the laws that go by volume: what it shares with the solid, how deep that is in
// flat bone and which way is out (Agus et al. 2002; reference/physics 1.1, 2.1-2.3). Frame P; mm. One overlap sum a
// call. Any shape. Servo thread. Not a force.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct Immersion {
  double volume_mm3 = 0.0;       ///< head and solid, as the voxels sum it
  double depth_mm = 0.0;         ///< of flat bone, free of the voxels' bias; 0: no contact
  double flat_volume_mm3 = 0.0;  ///< of that depth in flat bone: the volume free of bias
  double face_mm2 = 0.0;         ///< its change with depth
  double one_sided = 1.0;
  double tissue_factor = 1.0;                          ///< mean over what is shared
  calibration::Vector<calibration::Patient> normal_P;  ///< out of the bone
  calibration::Vector<calibration::Patient> arm_P_mm;  ///< from T's origin to the middle of what is shared
};

Immersion immersionOf(const ToolInBone& at) noexcept;

/// The contact of a law that pushes `force_N` along the normal, with this slope. Tissue is included here.
Contact contactAlongNormal(const Immersion& immersion, double force_N, double slope_N_per_mm) noexcept;

}  // namespace haptics
