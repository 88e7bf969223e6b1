// What the hand holds: a head that cuts and is felt, and a shaft that is felt and never cuts. Frame T, mm.
// Trivially copyable, part of a Command; any thread.
#pragma once

#include "haptics/tool/bur_shape.h"

namespace haptics {

/// A round rod along +z, from the origin of T to `length_mm`; its part inside the head counts as head. Length 0: none.
struct Shaft {
  double radius_mm = 0.0;
  double length_mm = 0.0;
};

struct Tool {
  BurShape head;
  Shaft shaft;
};

}  // namespace haptics
