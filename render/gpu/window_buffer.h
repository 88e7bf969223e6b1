// Which of a window's buffers is drawn into: a stereo window has two for the next picture. Plain value.
#pragma once

namespace render {

enum class WindowBuffer { back, back_left, back_right };

}  // namespace render
