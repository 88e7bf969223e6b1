// Finds the pixels that antialiasing draws again: where the distance differs from a neighbour's by more than the slope
// of a surface explains. Twin of shaders/edge_mask.frag; at the border of the image the missing neighbour goes
// straight on. Any thread; about 2 ns a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/eye_image.h"

namespace render {

/// The pixels of rows `first_row` to before `end_row` that lie at an edge, x in the low half, y in the high.
void findEdges(const EyeImage& canvas, int first_row, int end_row, std::vector<std::uint32_t>& to);

inline glm::ivec2 edgePixel(std::uint32_t packed) {
  return {static_cast<int>(packed & 0xffffu), static_cast<int>(packed >> 16)};
}

}  // namespace render
