#include "calibration/png_file.h"

#include <cassert>
#include <fstream>
#include <vector>

#include "calibration/opencv_module.h"

namespace calibration {

void writePng(const std::string& path, glm::ivec2 size_px, std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y) * 4);
  const std::vector<std::uint8_t> png = openCvModule().encoded_png(size_px, rgba);
  if (png.empty()) throw CalibrationError("image " + path + ": it cannot be encoded, retry");
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  file.close();
  if (!file) throw CalibrationError("image " + path + ": it cannot be written, check the folder and the free space");
}

}  // namespace calibration
