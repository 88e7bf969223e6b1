// A camera and how it was measured, as a YAML file (OpenCV FileStorage): `schema: 1`, `kind: "molar_camera"`, `name`,
// `serial`, `measured_utc`, `size_px: [2]`, `focal_px: [2]`, `centre_px: [2]`, `distortion: [k1, k2, p1, p2]`,
// `rms_px`, `views`. Start-up only; not the servo.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

struct CameraRecord {
  CameraModel camera;
  std::string name, serial;  ///< of the webcam; serial may be empty
  std::string measured_utc;  ///< "2026-11-22T08:20:00Z"
  double rms_px = 0.0;
  int views = 0;
};

/// Throws CalibrationError, one line with file, key and remedy: unreadable, not finite, no lens that can be.
CameraRecord readCamera(const std::string& path);

/// The text of such a file; writing it is the caller's.
std::string cameraText(const CameraRecord& record);

}  // namespace calibration
