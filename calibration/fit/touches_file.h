// Observations as a YAML file (OpenCV FileStorage): `device_model`, `observations: [{ id, joints_rad: [6], p_W_mm: [3],
// used }]`; optional `serial`, `mount`, `method`, `precision_mm: [in plane, along sight]`. Start-up only; not the
// servo.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/fit/touches.h"

namespace calibration {

/// Throws CalibrationError, one line with file, touch and remedy: unreadable, truncated, not finite, an unknown model,
/// more than 10,000 touches, beyond 2 m, angles beyond two turns. Duplicates and collinear sets are the fit's business.
TouchSet readTouches(const std::string& path);

/// The text of such a file; writing it is the caller's.
std::string touchesText(const TouchSet& set);

}  // namespace calibration
