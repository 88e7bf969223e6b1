// A camera's image from a file (JPEG or PNG) as grey. What the file says of its size is compared with limits before
// anything is decoded; a file that ends too early is refused. Start-up and command line; milliseconds.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// Throws CalibrationError: not there, beyond 32 MiB, neither PNG nor JPEG, damaged, cut off, a side under 16 or beyond
/// 16384 px, beyond 64 megapixels.
GreyImage readGreyImage(const std::string& path);

}  // namespace calibration
