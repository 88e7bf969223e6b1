// Where the surgeon sees the screen: the panel's corners in the rig's mirror, or as they are without one. The mirror
// flip is in them: nothing else has to know of it. Frame W, mm. Pure; any thread; a few flops.
#pragma once

#include "calibration/rig.h"

namespace calibration {

/// Corners of the framebuffer's image, as they are seen.
inline ScreenCorners virtualScreen(const Rig& rig) {
  ScreenCorners seen = rig.screen;
  if (rig.mirror)
    for (Point<World>* const corner : {&seen.lower_left, &seen.lower_right, &seen.upper_left})
      *corner = rig.mirror->reflect(*corner);
  return seen;
}

}  // namespace calibration
