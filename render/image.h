// Images on the CPU: plain values, rows top first. Any thread.
#pragma once

#include <cstdint>
#include <vector>

namespace render {

struct Image {
  int w = 0, h = 0;
  std::vector<std::uint8_t> rgba;  ///< sRGB, 4 bytes a pixel
};

/// Distance along the ray to the drawn surface, mm; 0 where the ray hits nothing.
struct DistanceImage {
  int w = 0, h = 0;
  std::vector<float> mm;
};

}  // namespace render
