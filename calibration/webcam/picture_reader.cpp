#include "calibration/webcam/picture_reader.h"

#include <filesystem>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace calibration {

GreyPicture readGreyPicture(const std::string& path) {
  const auto refuse = [&](const char* what) {
    throw CalibrationError("picture " + path + ": " + what + ", give a JPEG or PNG of the camera");
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("it can not be read");
  cv::Mat grey;
  try {
    grey = cv::imread(path, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    refuse("it is damaged or too large");
  }
  if (grey.empty()) refuse("it is not a picture");
  if (grey.total() > (std::size_t{64} << 20)) refuse("it has more than 64 megapixels");
  GreyPicture picture{{grey.cols, grey.rows}, {}};
  for (int y = 0; y < grey.rows; ++y) picture.grey.insert(picture.grey.end(), grey.ptr(y), grey.ptr(y) + grey.cols);
  return picture;
}

}  // namespace calibration
