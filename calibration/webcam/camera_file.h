// A camera's lens and how it was measured, as YAML (OpenCV FileStorage): `schema: 1`, `kind: "molar_camera"`, `name`,
// `serial`, `measured_utc`, `size_px: [2]`, `focal_px: [2]`, `centre_px: [2]`, `distortion: [k1, k2, p1, p2]`,
// `rms_px`, `views`; and the four lens keys alone, for the file of webcam observations. px. Start-up only.
#pragma once

#include <string>
#include <string_view>

#include "calibration/checked_yaml.h"
#include "calibration/webcam/camera.h"
#include "calibration/yaml_writer.h"

namespace calibration {

struct CameraRecord {
  CameraModel camera;
  std::string name, serial;  ///< of the webcam; serial may be empty
  std::string measured_utc;  ///< "2026-11-22T08:20:00Z"
  double rms_px = 0.0;
  int views = 0;
};

/// Throws CalibrationError with file, key and remedy: unreadable, not finite, an implausible lens.
CameraRecord readCamera(const std::string& path);

/// The text of such a file; the caller writes it.
std::string cameraText(const CameraRecord& record);

/// The key of a parameter that no webcam's lens has; empty: none. A webcam's field of view is 10 to 150 degrees, its
/// pixels are square within a tenth, its centre is in the image and its distortion less than a fish-eye's.
std::string_view implausibleParameter(const CameraModel& camera);

/// The lens keys of a map. Throws CalibrationError naming the key: missing, not finite or implausible.
CameraModel cameraIn(const CheckedYaml& yaml, const cv::FileNode& node);
void writeCamera(YamlWriter& out, const CameraModel& camera);

}  // namespace calibration
