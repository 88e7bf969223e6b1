// Sliding speed of a turning bur on the bone it is pressed on: the mean of |r x axis|, mm, over the contact, weighted
// with Hertz's pressure p(x) = sqrt(1 - |x|^2 / a^2) over a disc of radius a = sqrt(h (2R - h)) (Agus et al. 2002;
// reference/physics 1.1). Times the spindle's speed it is v_c of the erosion law `dose`; for h << R it is R sin(theta).
// Quadrature of the paper's integral, 80 points, 0.4 us. Any thread. Frame of the arguments.
//   sphere, capsule: as above.     cylinder: R |sin| on its side, 2/3 R on its end.     cone: R/2 on its side.
#pragma once

#include "haptics/tool/bur_shape.h"

namespace haptics {

/// `sine` of the angle between the contact's normal and the spindle's axis; 0..1.
double slidingArm_mm(const BurShape& head, double depth_mm, double sine) noexcept;

}  // namespace haptics
