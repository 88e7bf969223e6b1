// Reads a JPEG or PNG file as grey image. The declared size is checked before decoding; a truncated file is refused.
// Start-up and command line; milliseconds.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// Throws CalibrationError: missing, beyond 32 MiB, not PNG or JPEG, damaged, truncated, a side under 16 or beyond
/// 16384 px, beyond 64 megapixels.
GreyImage readGreyImage(const std::string& path);

}  // namespace calibration
