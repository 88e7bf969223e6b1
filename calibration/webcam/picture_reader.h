// A camera's picture from a file (JPEG, PNG, …) as grey. Start-up and command line; milliseconds.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// Throws CalibrationError: not there, not a picture, beyond 64 megapixels.
GreyPicture readGreyPicture(const std::string& path);

}  // namespace calibration
