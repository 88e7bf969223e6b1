// True size of the screen's image, from bars of nominal length and a ruler, across and up. A webcam cannot measure it:
// a screen twice as large at twice the distance looks the same, and the arm's own scale is known to about 0.5 % only.
// Frame W, mm. Any thread. A ruler reads to 0.3 mm.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/rig.h"

namespace calibration {

/// Measured lengths of two bars drawn as `drawn_mm`.
struct MeasuredBars {
  double drawn_mm = 100.0;
  double across_mm = 100.0, up_mm = 100.0;  ///< across: along the framebuffer's rows
};

struct SizeCheck {
  double across = 1.0, up = 1.0;  ///< true size over assumed size
  bool agrees = true;             ///< within a ruler's accuracy: nothing was changed
  ScreenCorners corners;          ///< as measured, about the same centre
  std::string line;               ///< for the technician
};

/// Throws CalibrationError with the remedy: bars under 50 mm, more than 20 % off (another unit, another monitor, a
/// cropped image), or stretched by more than 3 % one way (not the native resolution).
SizeCheck checkedSize(const ScreenCorners& nominal, const MeasuredBars& bars);

}  // namespace calibration
