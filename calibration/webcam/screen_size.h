// How large the screen's image truly is, from a bar that is drawn so many mm long and a ruler laid on it, across and
// up. A webcam can not say it: a screen twice as large twice as far looks the same, only the arm's own millimetres
// tell them apart, to about 0.5 %. Frame W, mm. Any thread. A ruler reads to 0.3 mm.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/rig.h"

namespace calibration {

/// How long the two bars are that were drawn as `drawn_mm`.
struct MeasuredBars {
  double drawn_mm = 100.0;
  double across_mm = 100.0, up_mm = 100.0;  ///< across: along the framebuffer's rows
};

struct SizeCheck {
  double across = 1.0, up = 1.0;  ///< true size over believed size
  bool agrees = true;             ///< within what a ruler reads: nothing was changed
  ScreenCorners corners;          ///< as measured, the middle where it was
  std::string line;               ///< for the technician
};

/// Throws CalibrationError with the remedy: bars under 50 mm, beyond 20 % of what was drawn (another unit, another
/// monitor, a image that is cut off), or stretched by more than 3 % one way (not the monitor's own resolution).
SizeCheck checkedSize(const ScreenCorners& believed, const MeasuredBars& bars);

}  // namespace calibration
