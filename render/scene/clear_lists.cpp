#include "render/scene/clear_lists.h"

#include <algorithm>
#include <array>

#include "render/gpu/drawing.h"
#include "render/shaders/shared_numbers.glsl"

namespace render {
namespace {

constexpr std::size_t kHeader_bytes = 8, kPlace_bytes = 16, kPlacesPerPixel = 4, kMost_bytes = std::size_t{128} << 20;

}  // namespace

void ClearLists::begin(glm::ivec2 size) {
  if (!over_) over_ = Program{"screen.vert", "clear_over.frag"};
  if (heads_.size() != glm::ivec3(size, 1)) {
    heads_ = Texture::picture(size, TexelFormat::r32ui);
    const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    capacity_ =
        static_cast<std::uint32_t>(std::min(kPlacesPerPixel * pixels, (kMost_bytes - kHeader_bytes) / kPlace_bytes));
    list_ = Buffer::ofSize(kHeader_bytes + kPlace_bytes * capacity_);
  }
  const std::array<std::uint32_t, 2> header{0, capacity_};
  list_.update(std::as_bytes(std::span(header)));
  list_.bindStorage(CLEAR_LIST);
  heads_.fill(~std::uint32_t{0});
  heads_.bindForReadingAndWriting(CLEAR_HEADS_IMAGE);
}

void ClearLists::layOver(const Framebuffer& picture) {
  finishStorageWrites();
  picture.bind();
  drawScreen(*over_, {.depth_test = false, .depth_write = false, .lay_over = true, .write_distance = false});
}

}  // namespace render
