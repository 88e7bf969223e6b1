// Lower teeth that a label map has under one value, told apart: divided at their necks (segment/thick_parts.h), with
// the rise raised until no more parts are left than a jaw has teeth, and numbered along the arch
// (segment/tooth_numbers.h). Of a person's or a net's outlines only the numbers are proposed here. Frame P. Any thread
// but the servo; 1 s for a jaw at 0.35 mm.
#pragma once

#include <cstddef>

#include "assets/ct_volume.h"

namespace assets {

/// Numbers of what is labelled `other_teeth`, into `tooth`; how many teeth have one.
std::size_t divideLabelledTeeth(CtVolume& ct);

}  // namespace assets
