// Shows a texture in the current window, scaled to its place. Works in every context that shares the texture with the
// one it was made in, once that one's drawing was flushed. Thread: the context's.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_target.h"

namespace render {

void showImageOnWindow(const Texture& image, const WindowTarget& place);
/// All of the current window's buffer to black.
void clearWindow(WindowBuffer buffer = WindowBuffer::back);

}  // namespace render
