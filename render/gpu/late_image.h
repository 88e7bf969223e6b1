// A small copy of a render target, read back without waiting for the GPU: asked for at one frame, there at a later one,
// usually the next. Move-only. Thread: the context's. Cost: some 10 µs to ask, and a copy of the small picture.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/gpu/frame_fence.h"
#include "render/gpu/framebuffer.h"
#include "render/image.h"

namespace render {

class LateImage {
 public:
  /// Where nothing is on its way: asks for `from` as it is now, scaled to fit into `most_px`, and returns none. Where
  /// it has not come yet: none. Else what was asked for, top row first.
  std::optional<Image> take(const Framebuffer& from, glm::ivec2 most_px);

 private:
  void ask(const Framebuffer& from, glm::ivec2 most_px);

  Framebuffer small_;
  GlName pixels_;
  std::size_t bytes_ = 0;
  FrameFence there_;
  bool is_on_its_way_ = false;
};

}  // namespace render
