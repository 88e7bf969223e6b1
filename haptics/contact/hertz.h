// Hertz's law of a ball on flat bone: F = C1 R^1/2 h^3/2 n (the elastic force of Agus et al. 2002-3,
// reference/physics 1.1), with h and n of contact/immersion. Frame P; mm, N. C1 of real bone, about 2e4 N/mm^2, is four
// orders beyond what a device can render: here it is a gain. Soft at first touch, stiffens as h^1/2. Servo thread; one
// overlap sum.
#pragma once

#include "haptics/contact/contact.h"

namespace haptics {

struct HertzParameters {
  double hertz_N_per_mm2 = 2.0;  ///< C1; 1 N at 0.5 mm under a ball of 2 mm (reference/physics 6)
};

Contact hertzContact(const HertzParameters& parameters, const ToolInBone& at) noexcept;

}  // namespace haptics
