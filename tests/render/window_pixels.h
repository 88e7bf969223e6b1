// Reads the back buffer of the current window.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render::testing {

/// RGBA, rows top first, opaque.
inline std::vector<std::uint8_t> windowPixels(glm::ivec2 size) {
  std::vector<std::uint8_t> pixels;
  const auto row_bytes = 4 * static_cast<std::size_t>(size.x);
  std::vector<std::uint8_t> row(row_bytes);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  for (int y = size.y - 1; y >= 0; --y) {
    glReadPixels(0, y, size.x, 1, GL_RGBA, GL_UNSIGNED_BYTE, row.data());
    for (std::size_t a = 3; a < row_bytes; a += 4) row[a] = 255;
    pixels.insert(pixels.end(), row.begin(), row.end());
  }
  return pixels;
}

}  // namespace render::testing
