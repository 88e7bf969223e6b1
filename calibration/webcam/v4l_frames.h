// Frames of a V4L2 camera by OpenCV, with focus, zoom and exposure fixed as they were found or asked for. One thread.
#pragma once

#include <memory>
#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/live_image_source.h"
#include "calibration/webcam/webcam_source.h"

namespace calibration {

/// Waits for the first frame. Throws CalibrationError: busy, no image, another size than requested.
std::unique_ptr<FrameGrabber> openV4lFrames(const std::string& path, const WebcamSettings& wanted);

}  // namespace calibration
