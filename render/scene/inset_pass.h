// Draws small images over an eye's linear light so that the output pass reproduces them exactly: their sRGB is decoded
// and passed through the inverse shoulder. Render thread; a textured rectangle each. Distances stay those of the scene.
#pragma once

#include <span>

#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"
#include "render/image.h"

namespace render {

class InsetPass {
 public:
  struct GpuInset {
    Texture image;
    glm::ivec2 first_px{0}, size_px{0};  ///< in the eye's image, from its top left
  };

  static Texture uploaded(const Image& image);
  /// `samples`: samples of the target along each edge of the eye's pixels.
  void draw(std::span<const GpuInset> insets, const Framebuffer& target, int samples);

 private:
  Program program_{"screen.vert", "inset.frag"};
};

}  // namespace render
