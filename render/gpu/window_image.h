// Shows an image in the current window, scaled to its target area. Thread: the context's.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_target.h"
#include "render/image.h"

namespace render {

/// Works in every context that shares the texture with its own, once the drawing to it was flushed.
void showImageOnWindow(const Texture& image, const WindowTarget& target);
/// Clears the current window's buffer to black.
void clearWindow(WindowBuffer buffer = WindowBuffer::back);

/// Uploads images from the CPU and shows them. Cost: 1 ms for 640x480.
class WindowUpload {
 public:
  void show(const Image& image, WindowTarget target);

 private:
  Texture texture_;
};

}  // namespace render
