// OpenCV's cameras and picture files. They bring 162 libraries of the system along, which take 0.2 s to link: they are
// in a library of their own, molar_pictures.so, that is loaded at the first use. Any thread; the first call takes that
// time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "calibration/calibration_error.h"

namespace calibration {

class FrameGrabber;
struct GreyImage;
struct WebcamSettings;

struct OpenCvModule {
  /// Of a V4L2 camera, with focus, zoom and exposure fixed. Throws CalibrationError.
  std::unique_ptr<FrameGrabber> (*camera)(const std::string& path, const WebcamSettings& wanted);
  /// Of a PNG or JPEG file whose size was checked. An image of no size: damaged.
  GreyImage (*decoded_grey)(std::span<const std::uint8_t> file);
  /// The file of an image of 8-bit RGB, rows from the top. Empty: it cannot be encoded.
  std::vector<std::uint8_t> (*encoded_png)(glm::ivec2 size_px, std::span<const std::uint8_t> rgba);
};

/// Throws CalibrationError where the library is not beside the program as it was installed.
const OpenCvModule& openCvModule();

}  // namespace calibration
