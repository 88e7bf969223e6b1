#include "calibration/webcam/picture_matrix.h"

#include <opencv2/core.hpp>

namespace calibration {

bool isWhole(const GreyPicture& picture) {
  const glm::ivec2 size = picture.size_px;
  return size.x > 0 && size.y > 0 &&
         picture.grey.size() == static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

cv::Mat matrixOf(const GreyPicture& picture) {
  return {picture.size_px.y, picture.size_px.x, CV_8U, const_cast<std::uint8_t*>(picture.grey.data())};
}

GreyPicture greyPictureOf(const cv::Mat& grey) {
  GreyPicture picture{{grey.cols, grey.rows}, {}};
  picture.grey.reserve(grey.total());
  for (int y = 0; y < grey.rows; ++y) picture.grey.insert(picture.grey.end(), grey.ptr(y), grey.ptr(y) + grey.cols);
  return picture;
}

}  // namespace calibration
