// Where in the current window something is shown. A stereo window has two buffers for the next image. Plain values.
#pragma once

#include <glm/glm.hpp>

namespace render {

enum class WindowBuffer { back, back_left, back_right };

struct WindowTarget {
  glm::ivec2 size_px{0};    ///< what is shown is scaled to it
  glm::ivec2 corner_px{0};  ///< from the window's lower left
  WindowBuffer buffer = WindowBuffer::back;
  bool flipped_x = false, flipped_y = false;  ///< as someone sees it who looks at the panel by a mirror
};

}  // namespace render
