// Shows a texture in the current window, scaled to its place. Works in every context that shares the texture with the
// one it was made in, once that one's drawing was flushed. Thread: the context's.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_place.h"

namespace render {

void showPictureOnWindow(const Texture& picture, const WindowPlace& place);
/// All of the current window's buffer to black.
void blackenWindow(WindowBuffer buffer = WindowBuffer::back);

}  // namespace render
