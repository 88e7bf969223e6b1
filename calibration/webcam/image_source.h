// Where a procedure's images come from: a webcam, a folder, a rendered workstation. One thread at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// One whose light was gathered after this call. Waits for it some seconds at the most. Throws CalibrationError:
  /// there is none.
  virtual GreyImage take() = 0;
  virtual std::string name() const = 0;  ///< for people: "webcam /dev/video0"
};

/// Paths of a folder's PNG and JPEG files, by the last number in their names. Throws CalibrationError: no folder, no
/// images in it, more than 10,000.
std::vector<std::string> imageFilesIn(const std::string& folder);

/// These images, one a call, then an error. Throws as imageFilesIn.
std::unique_ptr<ImageSource> imageFolder(const std::string& path);

/// Whatever makes images.
class SyntheticImageSource final : public ImageSource {
 public:
  SyntheticImageSource(std::string name, std::function<GreyImage()> make)
      : name_(std::move(name)), make_(std::move(make)) {}
  GreyImage take() override { return make_(); }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  std::function<GreyImage()> make_;
};

}  // namespace calibration
