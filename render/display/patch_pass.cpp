#include "render/display/patch_pass.h"

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

void PatchPass::update(std::span<const OverlayPatch> patches, std::vector<GpuPatch>& on_gpu) {
  on_gpu.resize(patches.size());
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const OverlayPatch& patch = patches[n];
    GpuPatch& to = on_gpu[n];
    to.corners_px = patch.corners_px;
    const glm::ivec2 size{patch.image.w, patch.image.h};
    const bool fits = glm::ivec2(to.image.size()) == size;
    if (patch.corners_px.empty() || (fits && to.serial == patch.serial)) continue;
    if (!fits) to.image = Texture::image(size, TexelFormat::rgba8);
    to.image.uploadImage(std::as_bytes(std::span(patch.image.rgba)));  // top row first: the shader flips it
    to.serial = patch.serial;
  }
}

void PatchPass::draw(std::span<const GpuPatch> patches, const Framebuffer& output) const {
  if (patches.empty()) return;
  output.bind();
  for (const GpuPatch& patch : patches) {
    const glm::ivec2 size = patch.image.size();
    for (const glm::ivec2& corner : patch.corners_px) {
      setViewport({corner.x, output.size().y - corner.y - size.y}, size);
      patch.image.bind(INSET_UNIT);
      drawScreen(program_, {.depth_test = false, .depth_write = false, .blend = true, .write_distance = false});
    }
  }
  output.bind();
}

}  // namespace render
