#include "render/scene/inset_pass.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

Texture InsetPass::uploaded(const Image& image) {
  Texture texture = Texture::image({image.w, image.h}, TexelFormat::rgba8);
  texture.uploadImage(std::as_bytes(std::span(image.rgba)));  // top row first: the shader flips it
  return texture;
}

void InsetPass::draw(std::span<const GpuInset> insets, const Framebuffer& target, int samples) {
  if (insets.empty()) return;
  target.bind();
  for (const GpuInset& inset : insets) {
    const glm::ivec2 first = samples * inset.first_px, size = samples * inset.size_px;
    setViewport({first.x, target.size().y - first.y - size.y}, size);
    inset.image.bind(INSET_UNIT);
    drawScreen(program_, {.depth_test = false, .depth_write = false, .write_distance = false});
  }
  target.bind();
}

}  // namespace render
