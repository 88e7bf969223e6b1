// Pictures of a real webcam on Linux (V4L2 through OpenCV): focus, zoom and exposure held still, for a lens that moves
// is another lens. A missing camera, one that is busy, and one that falls silent are one line each, within seconds. Any
// one thread. Not tried on a camera of every make: what one would not do is said.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "calibration/webcam/image_source.h"

namespace calibration {

struct WebcamSettings {
  std::string device = "0";  ///< index or path: "0", "/dev/video2"
  glm::ivec2 size_px{1920, 1080};
  std::optional<double> exposure_ms;  ///< none: as bright as it chose by itself when it was opened
  std::optional<double> focus;        ///< in the camera's own steps; none: where it stands
};

struct OpenedImageSource {
  std::unique_ptr<ImageSource> images;
  std::string remarks;  ///< what it would not do: "focus can not be fixed"; empty: all as asked
};

/// "0" or "/dev/video2" for a webcam, else a folder's path. Throws CalibrationError: not there, no permission, no
/// camera, busy, another size than asked for.
OpenedImageSource openImageSource(const WebcamSettings& wanted);

}  // namespace calibration
