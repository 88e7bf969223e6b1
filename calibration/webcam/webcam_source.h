// Images of a webcam on Linux (V4L2 through OpenCV) with focus, zoom and exposure fixed, because each changes the lens.
// A missing, busy or silent camera is reported in one line within seconds. Any one thread. Settings that a camera
// refuses are reported.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "calibration/webcam/image_source.h"

namespace calibration {

struct WebcamSettings {
  std::string device = "0";  ///< index or path: "0", "/dev/video2"
  glm::ivec2 size_px{1920, 1080};
  std::optional<double> exposure_ms;  ///< none: as found automatically when opened
  std::optional<double> focus;        ///< in the camera's steps; none: unchanged
};

struct OpenedImageSource {
  std::unique_ptr<ImageSource> images;
  std::string remarks;  ///< settings it refused: "focus cannot be fixed"; empty: none
};

/// "0" or "/dev/video2": a webcam; otherwise a folder. Throws CalibrationError: missing, no permission, not a camera,
/// busy, another size than requested.
OpenedImageSource openImageSource(const WebcamSettings& wanted);

}  // namespace calibration
