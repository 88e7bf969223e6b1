// A image that was made without OpenGL on its way to the current window: uploaded, then scaled onto the framebuffer.
// Thread: the context's. Cost: 1 ms for 640x480.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_target.h"
#include "render/image.h"

namespace render {

class WindowUpload {
 public:
  void show(const Image& image, WindowTarget place);

 private:
  Texture texture_;
};

}  // namespace render
