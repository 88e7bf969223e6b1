// A camera's numbers inside a YAML file: `size_px: [2]`, `focal_px: [2]`, `centre_px: [2]`, `distortion: [k1, k2, p1,
// p2]`; and which numbers a webcam can have. A part of camera_file, webcam_file and intrinsics. px. Start-up only.
#pragma once

#include <string_view>

#include "calibration/checked_yaml.h"
#include "calibration/webcam/camera.h"

namespace cv {
class FileStorage;
}

namespace calibration {

/// Which of its numbers no webcam's lens has, as files call it; empty: it is one. A lens fits its image, sees 10 to
/// 150 degrees, its pixels are square within a tenth, and it bends less than a fish-eye.
std::string_view implausibleParameter(const CameraModel& camera);

/// Throws CalibrationError naming the key: missing, not finite, or no webcam's lens.
CameraModel cameraIn(const CheckedYaml& yaml, const cv::FileNode& node);

/// Into the map that is open.
void writeCamera(cv::FileStorage& out, const CameraModel& camera);

}  // namespace calibration
