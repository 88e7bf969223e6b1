// What molar_pictures.so gives.
#include <algorithm>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "calibration/opencv_module.h"
#include "calibration/webcam/image_matrix.h"
#include "calibration/webcam/v4l_frames.h"

namespace calibration {
namespace {

GreyImage decodedGrey(std::span<const std::uint8_t> file) {
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8U, const_cast<std::uint8_t*>(file.data()));
  try {
    const cv::Mat grey = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    return grey.type() == CV_8U ? greyImageOf(grey) : GreyImage();
  } catch (const cv::Exception&) {
    return {};
  }
}

std::vector<std::uint8_t> encodedPng(glm::ivec2 size_px, std::span<const std::uint8_t> rgba) {
  // OpenCV stores BGR; alpha is dropped.
  cv::Mat bgr(size_px.y, size_px.x, CV_8UC3);
  const std::uint8_t* in = rgba.data();
  for (std::uint8_t *out = bgr.data, *end = out + bgr.total() * 3; out != end; out += 3, in += 4) {
    out[0] = in[2];
    out[1] = in[1];
    out[2] = in[0];
  }
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", bgr, png)) return {};
  return png;
}

}  // namespace

/// Found by its name.
extern "C" const OpenCvModule* molarOpenCvModule() {
  static constexpr OpenCvModule kModule{&openV4lFrames, &decodedGrey, &encodedPng};
  return &kModule;
}

}  // namespace calibration
