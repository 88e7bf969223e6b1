#include "render/scene/fragment_lists.h"

#include <algorithm>
#include <array>

#include "render/gpu/drawing.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

constexpr std::size_t kHeader_bytes = 8, kPlace_bytes = 16, kPlacesPerPixel = 4, kMax_bytes = std::size_t{128} << 20;

}  // namespace

void FragmentLists::begin(glm::ivec2 size) {
  if (!over_) over_ = Program{"screen.vert", "fragment_blend.frag"};
  if (heads_.size() != glm::ivec3(size, 1)) {
    heads_ = Texture::image(size, TexelFormat::r32ui);
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    capacity_ =
        static_cast<std::uint32_t>(std::min(kPlacesPerPixel * pixels, (kMax_bytes - kHeader_bytes) / kPlace_bytes));
    list_ = Buffer::ofSize(kHeader_bytes + kPlace_bytes * capacity_);
  }
  const std::array<std::uint32_t, 2> header{0, capacity_};
  list_.update(std::as_bytes(std::span(header)));
  list_.bindStorage(FRAGMENT_LIST);
  heads_.fill(~std::uint32_t{0});
  heads_.bindForReadingAndWriting(FRAGMENT_HEADS_IMAGE);
}

void FragmentLists::blendOver(const Framebuffer& image) {
  finishStorageWrites();
  image.bind();
  // Its distance is read and not written.
  finishTargetWrites();
  image.colour(DISTANCE_TARGET).bind(SCENE_DISTANCE_UNIT);
  drawScreen(*over_, {.depth_test = false, .depth_write = false, .blend = true, .write_distance = false});
}

}  // namespace render
