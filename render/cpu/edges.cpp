#include "render/cpu/edges.h"

#include <algorithm>
#include <cmath>

#include "render/shaders/light_constants.glsl"

namespace render {
namespace {

float inverse(float distance_mm) { return distance_mm > 0.0f ? 1.0f / distance_mm : 0.0f; }

bool bends(float a, float here, float b) {
  return std::abs(a - 2.0f * here + b) > EDGE_BEND * std::max(std::max(a, b), std::max(here, 1e-9f));
}

}  // namespace

void findEdges(const EyeImage& image, int first_row, int end_row, std::vector<std::uint32_t>& to) {
  const int w = image.px.x, h = image.px.y;
  // Inverse distances of three rows, each extrapolated linearly by one value at both ends.
  std::vector<float> rows[3];
  for (std::vector<float>& row : rows) row.resize(static_cast<std::size_t>(w) + 2);
  const auto load = [&](std::vector<float>& row, int y) {
    const float* const from = &image.silhouettes_mm()[image.at(0, y)];
    for (int x = 0; x < w; ++x) row[static_cast<std::size_t>(x) + 1] = inverse(from[x]);
    row[0] = w > 1 ? 2.0f * row[1] - row[2] : row[1];
    row[static_cast<std::size_t>(w) + 1] =
        w > 1 ? 2.0f * row[static_cast<std::size_t>(w)] - row[static_cast<std::size_t>(w) - 1] : row[1];
  };
  const auto row = [&](int y) -> std::vector<float>& { return rows[(y + 3) % 3]; };
  if (first_row >= end_row) return;
  load(row(first_row), first_row);
  if (first_row > 0) load(row(first_row - 1), first_row - 1);
  for (int y = first_row; y < end_row; ++y) {
    if (y + 1 < h) load(row(y + 1), y + 1);
    const float *const here = row(y).data() + 1, *const above = row(y - 1).data() + 1,
                       *const below = row(y + 1).data() + 1;
    const bool inside = y > 0 && y + 1 < h;
    for (int x = 0; x < w; ++x)
      if (bends(here[x - 1], here[x], here[x + 1]) || (inside && bends(above[x], here[x], below[x])))
        to.push_back(static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x));
  }
}

}  // namespace render
