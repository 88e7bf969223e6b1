// Area of the current window in which an image is shown. A stereo window has two back buffers. Plain values.
#pragma once

#include <glm/glm.hpp>

namespace render {

enum class WindowBuffer { back, back_left, back_right };

struct WindowTarget {
  glm::ivec2 size_px{0};    ///< the image is scaled to it
  glm::ivec2 corner_px{0};  ///< from the window's lower left
  WindowBuffer buffer = WindowBuffer::back;
  bool flipped_x = false, flipped_y = false;  ///< for a viewer who sees the panel in a mirror
};

}  // namespace render
