// One look at the bone with a head of any shape, as the height law of Agus sees it (contact/agus has the sphere alone):
// how deep in flat bone the shared volume would be, out of which direction, and where it acts. Frame P; mm. Servo
// thread (or any that may read the field); one overlap sum and under 15 µs. Not a force.
//   n = A / |A|, A the bone's surface inside the head (contact/shape_overlap); -M1 for a sphere, which is quieter
//   h from V by the flat overlap of this shape at this angle (tool/flat_overlap), less the voxels' smear
//     sigma^2 = eta^2/5 - s^2/12 + s g,   g = grey/A as in contact/cap
// Where bone on all sides cancels out n gets shorter than 1 instead of turning at random.
#pragma once

#include "haptics/contact/contact.h"
#include "haptics/contact/shape_overlap.h"

namespace haptics {

struct ShapeContact {
  double volume_mm3 = 0.0;
  double depth_mm = 0.0;                               ///< 0: no contact
  calibration::Vector<calibration::Patient> normal_P;  ///< out of the bone, at most 1 long
  calibration::Vector<calibration::Patient>
      centroid_P_mm;              ///< of the shared volume, from T's origin: x F is the torque
  double area_mm2 = 0.0;          ///< dV/ddepth of flat bone there
  double one_sided = 1.0;         ///< |A| relative to flat bone of this depth, at most 1: 0 in a slot
  double stiffness_factor = 1.0;  ///< mean of the tissues' over the shared volume
};

ShapeContact shapeContact(const ToolInBone& at) noexcept;

}  // namespace haptics
