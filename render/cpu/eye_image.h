// An eye's image on the CPU, in planes, rows top first: linear light in 0..1, after the tone-mapping shoulder, and
// distance. Plain data; threads may write different pixels.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace render {

struct EyeImage {
  glm::ivec2 px{0};
  std::vector<float> r, g, b;
  std::vector<float> distance_mm;  ///< along the ray through the pixel centre, 0: nothing hit
  std::vector<float> seen_mm;      ///< the same, on beyond a mirror's glass; empty: there is none

  void resize(glm::ivec2 size) {
    if (size == px) return;
    px = size;
    const auto count = static_cast<std::size_t>(px.x) * static_cast<std::size_t>(px.y);
    // Kernels may read beyond the last value.
    for (std::vector<float>* plane : {&r, &g, &b, &distance_mm}) plane->assign(count + 16, 0.0f);
  }
  /// Where silhouettes are looked for.
  const std::vector<float>& silhouettes_mm() const { return seen_mm.empty() ? distance_mm : seen_mm; }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(px.x) + static_cast<std::size_t>(x);
  }
};

}  // namespace render
