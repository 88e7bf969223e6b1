// A camera's image as OpenCV has it, and back. px. Any thread.
#pragma once

#include "calibration/webcam/camera.h"

namespace cv {
class Mat;
}

namespace calibration {

/// It has a size, and as many bytes as that asks for.
bool isWhole(const GreyImage& image);

/// The image's own bytes: to be read only, and while it lives.
cv::Mat matrixOf(const GreyImage& image);

/// A copy of 8 bits a pixel.
GreyImage greyImageOf(const cv::Mat& grey);

}  // namespace calibration
