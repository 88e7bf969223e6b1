#include "calibration/webcam/image_reader.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "calibration/webcam/image_header.h"
#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

constexpr std::uintmax_t kLargestFile_bytes = 32 << 20;
constexpr int kSmallest_px = 16, kLargest_px = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{64} << 20;

}  // namespace

GreyImage readGreyImage(const std::string& path) {
  const auto refuse = [&](const char* what) {
    throw CalibrationError("picture " + path + ": " + what + ", give a JPEG or PNG of the camera");
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("it can not be read");
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes == 0 || bytes > kLargestFile_bytes) refuse("it is empty or has more than 32 MiB");
  std::vector<std::uint8_t> file(bytes);
  std::ifstream in(path, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(bytes))) refuse("it can not be read");

  // Its own words about its size first: a decoder would allocate whatever they say.
  const std::optional<glm::ivec2> size = declaredSize_px(file);
  if (!size) refuse("it is no whole PNG or JPEG");
  if (size->x < kSmallest_px || size->y < kSmallest_px || size->x > kLargest_px || size->y > kLargest_px)
    refuse("a side of it is under 16 or beyond 16384 pixels");
  if (std::int64_t{size->x} * size->y > kMostPixels) refuse("it has more than 64 megapixels");

  cv::Mat grey;
  try {
    grey = cv::imdecode(file, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    refuse("it is damaged");
  }
  if (grey.cols != size->x || grey.rows != size->y || grey.type() != CV_8U) refuse("it is damaged");
  return greyImageOf(grey);
}

}  // namespace calibration
