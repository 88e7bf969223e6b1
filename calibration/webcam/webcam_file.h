// What the webcam procedure gathered, as a YAML file (OpenCV FileStorage), so that a fit can be run again: `schema: 1`,
// `kind: "molar_webcam_observations"`, `device_model`, optional `serial`, `mount`; `camera: { size_px, focal_px,
// centre_px, distortion: [k1, k2, p1, p2] }`; `noise_px: [screen, tip]`; `positions: [{ screen: [[x, y, z mm in W, u, v
// px] …], tips: [{ id, joints_rad: [6], camera_px: [2] } …] } …]`. Start-up only; not the servo.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/webcam_fit.h"

namespace calibration {

struct WebcamObservationFile {
  WebcamObservations sights;
  std::string serial, mount;  ///< of the device; empty: not known
};

/// Whether a file says of itself that it is one; false for what can not be read at all.
bool isWebcamFile(const std::string& path);

/// Throws CalibrationError, one line with file, position and remedy: unreadable, truncated, not finite, an unknown
/// model, no lens that can be, pixels far beside the image, more than 12 positions, 20,000 places or 1,000 tips at
/// one. Whether it suffices for a fit is the fit's business.
WebcamObservationFile readWebcamFile(const std::string& path);

/// The text of such a file; writing it is the caller's.
std::string webcamFileText(const WebcamObservationFile& observations);

}  // namespace calibration
