// A camera's picture as OpenCV has it, and back. px. Any thread.
#pragma once

#include "calibration/webcam/camera.h"

namespace cv {
class Mat;
}

namespace calibration {

/// It has a size, and as many bytes as that asks for.
bool isWhole(const GreyPicture& picture);

/// The picture's own bytes: to be read only, and while it lives.
cv::Mat matrixOf(const GreyPicture& picture);

/// A copy of 8 bits a pixel.
GreyPicture greyPictureOf(const cv::Mat& grey);

}  // namespace calibration
