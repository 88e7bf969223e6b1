// Marks the pixels that antialiasing draws again, where the second difference of the inverse distance is large. Twin of
// shaders/edge_mask.frag; at the image border it is taken as zero. Any thread; about 2 ns a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/eye_image.h"

namespace render {

/// Appends the edge pixels of rows [first_row, end_row), x in the low half, y in the high.
void findEdges(const EyeImage& image, int first_row, int end_row, std::vector<std::uint32_t>& to);

inline glm::ivec2 edgePixel(std::uint32_t packed) {
  return {static_cast<int>(packed & 0xffffu), static_cast<int>(packed >> 16)};
}

}  // namespace render
