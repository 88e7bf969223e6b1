// The output pass: the eyes' linear images become the display's image, sRGB-encoded once. Which eye a pixel shows:
// stereo_layout.h. Render thread.
#pragma once

#include <glm/glm.hpp>

#include "render/display/stereo_layout.h"
#include "render/gpu/buffer.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

/// std140 twin of output.frag's block.
struct OutputBlock {
  glm::ivec4 mode{0}, output_px{0}, eye{0};
};

class StereoCompositor {
 public:
  /// `left` and `right`: linear images, `samples` values along each edge of a pixel, of eyeImageSize() or smaller;
  /// mono shows `left`. `output`: outputSize() large.
  void compose(const StereoLayout& layout, const Texture& left, const Texture& right, int samples,
               const Framebuffer& output);

 private:
  Program program_{"screen.vert", "output.frag"};
  UniformBlock<OutputBlock> block_;
};

}  // namespace render
