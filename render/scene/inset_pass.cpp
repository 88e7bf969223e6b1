#include "render/scene/inset_pass.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_numbers.glsl"

namespace render {

Texture InsetPass::onGpu(const Picture& picture) {
  Texture texture = Texture::picture({picture.w, picture.h}, TexelFormat::rgba8);
  texture.uploadPicture(std::as_bytes(std::span(picture.rgba)));  // top first: the shader turns it over
  return texture;
}

void InsetPass::draw(std::span<const Placed> insets, const Framebuffer& target, int samples) {
  if (insets.empty()) return;
  target.bind();
  for (const Placed& inset : insets) {
    const glm::ivec2 first = samples * inset.first_px, size = samples * inset.size_px;
    setViewport({first.x, target.size().y - first.y - size.y}, size);
    inset.picture.bind(INSET_UNIT);
    drawScreen(program_, {.depth_test = false, .depth_write = false, .write_distance = false});
  }
  target.bind();
}

}  // namespace render
