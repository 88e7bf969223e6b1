// Source of camera images: a webcam or a folder. One thread at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// An image exposed after this call; waits some seconds at most. Throws CalibrationError: none.
  virtual GreyImage take() = 0;
  virtual std::string name() const = 0;  ///< for people: "webcam /dev/video0"
};

/// PNG and JPEG files of a folder, ordered by the last number in their names. Throws CalibrationError: no folder, no
/// images, more than 10,000.
std::vector<std::string> imageFilesIn(const std::string& folder);

/// The images of a folder, one per call, then an error. Throws as imageFilesIn.
std::unique_ptr<ImageSource> imageFolder(const std::string& path);

}  // namespace calibration
