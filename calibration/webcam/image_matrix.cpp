#include "calibration/webcam/image_matrix.h"

#include <opencv2/core.hpp>

namespace calibration {

cv::Mat matrixOf(const GreyImage& image) {
  return {image.size_px.y, image.size_px.x, CV_8U, const_cast<std::uint8_t*>(image.grey.data())};
}

GreyImage greyImageOf(const cv::Mat& grey) {
  GreyImage image{{grey.cols, grey.rows}, {}};
  image.grey.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y) image.grey.insert(image.grey.end(), grey.ptr(y), grey.ptr(y) + grey.cols);
  return image;
}

}  // namespace calibration
