// A picture that was made without OpenGL on its way to the current window: uploaded, then scaled onto the framebuffer.
// Thread: the context's. Cost: 1 ms for 640x480.
#pragma once

#include "render/gpu/texture.h"
#include "render/gpu/window_place.h"
#include "render/picture.h"

namespace render {

class WindowUpload {
 public:
  void show(const Picture& picture, WindowPlace place);

 private:
  Texture texture_;
};

}  // namespace render
