// Shows a texture on the current window's framebuffer, scaled to it. Works in every context that shares the texture
// with the one it was made in, once that one's drawing was flushed. Thread: the context's.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_buffer.h"

namespace render {

void showPictureOnWindow(const Texture& picture, glm::ivec2 window_size, WindowBuffer buffer = WindowBuffer::back);

}  // namespace render
