#include "calibration/png_file.h"

#include <cassert>
#include <fstream>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace calibration {

void writePng(const std::string& path, glm::ivec2 size_px, std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y) * 4);
  // OpenCV stores BGR; alpha is dropped.
  cv::Mat bgr(size_px.y, size_px.x, CV_8UC3);
  const std::uint8_t* in = rgba.data();
  for (std::uint8_t *out = bgr.data, *end = out + bgr.total() * 3; out != end; out += 3, in += 4) {
    out[0] = in[2];
    out[1] = in[1];
    out[2] = in[0];
  }
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", bgr, png)) throw CalibrationError("image " + path + ": it cannot be encoded, retry");
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  file.close();
  if (!file) throw CalibrationError("image " + path + ": it cannot be written, check the folder and the free space");
}

}  // namespace calibration
