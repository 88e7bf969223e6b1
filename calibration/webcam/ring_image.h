// Draws a thin ring around the tip position: a monocular target, or a check of the calibrated arm. Frame W, mm, px. Any
// thread; 10 to 50 ms at 1080p.
#pragma once

#include "calibration/rig.h"
#include "calibration/webcam/camera.h"

namespace calibration {

inline constexpr double kRingRadius_mm = 8.0, kRingLine_mm = 0.8;

/// The framebuffer with a ring about `tip_W` as seen by the eye; flips follow from the rig's corners. White on black.
GreyImage ringImage(const Rig& rig, const Point<World>& eye_W, const Point<World>& tip_W);

}  // namespace calibration
