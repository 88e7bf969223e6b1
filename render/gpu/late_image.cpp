#include "render/gpu/late_image.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace render {

std::optional<Image> LateImage::take(const Framebuffer& from, glm::ivec2 most_px) {
  if (!is_on_its_way_) {
    ask(from, most_px);
    return {};
  }
  if (!there_.isReached()) return {};
  is_on_its_way_ = false;
  Image image;
  image.w = small_.size().x, image.h = small_.size().y;
  image.rgba.resize(bytes_);
  glGetNamedBufferSubData(pixels_.get(), 0, static_cast<GLsizeiptr>(bytes_), image.rgba.data());
  return image;
}

void LateImage::ask(const Framebuffer& from, glm::ivec2 most_px) {
  const glm::ivec2 whole = from.size();
  if (whole.x <= 0 || whole.y <= 0) return;
  const double shrink =
      std::min({1.0, static_cast<double>(most_px.x) / whole.x, static_cast<double>(most_px.y) / whole.y});
  const glm::ivec2 px = glm::max(glm::ivec2(1), glm::ivec2(glm::dvec2(whole) * shrink + 0.5));
  constexpr std::array kColour{TexelFormat::rgba8};
  small_.fit(px, kColour, false);
  const auto bytes = std::size_t{4} * static_cast<std::size_t>(px.x) * static_cast<std::size_t>(px.y);
  if (bytes != bytes_) {
    pixels_ = newBuffer();
    glNamedBufferStorage(pixels_.get(), static_cast<GLsizeiptr>(bytes), nullptr, GL_CLIENT_STORAGE_BIT);
    bytes_ = bytes;
  }
  // Turned over on the way: OpenGL has the bottom row first.
  from.scaleInto(small_, true);
  small_.readInto(pixels_.get());
  there_.mark();
  is_on_its_way_ = true;
}

}  // namespace render
