// Conversion between GreyImage and OpenCV. px. Any thread.
#pragma once

#include "calibration/webcam/camera.h"

namespace cv {
class Mat;
}

namespace calibration {

/// A read-only view of the image's bytes, valid while it lives.
cv::Mat matrixOf(const GreyImage& image);

/// A copy of an 8-bit image.
GreyImage greyImageOf(const cv::Mat& grey);

}  // namespace calibration
