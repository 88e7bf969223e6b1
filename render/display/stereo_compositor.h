// The output pass: the eyes' linear pictures become the one picture that the display is given, sRGB-encoded once.
// mono: one eye. side_by_side: left eye in the left half. top_bottom: left eye in the top half.
// anaglyph: red from the left eye, green and blue from the right, combined in linear light. Render thread.
#pragma once

#include <glm/glm.hpp>

#include "render/frame.h"
#include "render/gpu/buffer.h"
#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

/// Size of each eye's picture, px, for an output of `output` px.
glm::ivec2 eyePictureSize(DisplayMode mode, glm::ivec2 output);

/// std140 twin of output.frag's block.
struct OutputBlock {
  glm::ivec4 mode{0}, corner{0};
};

class StereoCompositor {
 public:
  StereoCompositor();

  /// `left` and `right`: linear pictures, `samples` times the eye picture's size along each edge. mono uses `left`
  /// only.
  void compose(DisplayMode mode, const Texture& left, const Texture& right, int samples, const Framebuffer& output);

 private:
  void show(int mode, const Texture& left, const Texture& right, int samples, glm::ivec2 corner, glm::ivec2 size);

  Program program_;
  UniformBlock<OutputBlock> block_;
};

}  // namespace render
