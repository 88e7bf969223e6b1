// Observations of the webcam procedure as a YAML file (OpenCV FileStorage), to repeat a fit: `schema: 1`, `kind:
// "molar_webcam_observations"`, `device_model`, optional `serial`, `mount`; `camera: { size_px, focal_px, centre_px,
// distortion: [k1, k2, p1, p2] }`; `noise_px: [screen, tip]`; `positions: [{ screen: [[x, y, z mm in W, u, v px] …],
// tips: [{ id, joints_rad: [6], camera_px: [2] } …] } …]`. Start-up only.
#pragma once

#include <string>

#include "calibration/calibration_error.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

/// Whether a file declares this kind; false for unreadable files.
bool isWebcamFile(const std::string& path);

/// Throws CalibrationError with file, position and remedy: unreadable, truncated, not finite, unknown model,
/// implausible lens, pixels far outside the image, more than 12 positions, 20,000 screen points or 1,000 tips at one.
/// The fit checks whether they suffice.
WebcamObservations readWebcamFile(const std::string& path);

/// The text of such a file; the caller writes it.
std::string webcamFileText(const WebcamObservations& observations);

}  // namespace calibration
