// Where a procedure's pictures come from: a webcam, a folder, a rendered workstation. One thread at a time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

class PictureSource {
 public:
  virtual ~PictureSource() = default;

  /// One whose light was gathered after this call. Waits for it some seconds at the most. Throws CalibrationError:
  /// there is none.
  virtual GreyPicture take() = 0;
  virtual std::string name() const = 0;  ///< for people: "webcam /dev/video0"
};

/// Paths of a folder's PNG and JPEG files, by the last number in their names. Throws CalibrationError: no folder, no
/// pictures in it, more than 10,000.
std::vector<std::string> picturesIn(const std::string& folder);

/// These pictures, one a call, then an error. Throws as picturesIn.
std::unique_ptr<PictureSource> pictureFolder(const std::string& path);

/// Whatever makes pictures.
class MadePictures final : public PictureSource {
 public:
  MadePictures(std::string name, std::function<GreyPicture()> make) : name_(std::move(name)), make_(std::move(make)) {}
  GreyPicture take() override { return make_(); }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  std::function<GreyPicture()> make_;
};

}  // namespace calibration
