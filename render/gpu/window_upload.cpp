#include "render/gpu/window_upload.h"

#include <algorithm>

#include "render/gpu/window_picture.h"

namespace render {

void WindowUpload::show(const Picture& picture, const WindowPlace& place) {
  const glm::ivec2 size(picture.w, picture.h);
  if (glm::ivec2(texture_.size()) != size) texture_ = Texture::picture(size, TexelFormat::rgba8);
  const std::size_t row = 4 * static_cast<std::size_t>(picture.w);
  bottom_first_.resize(picture.rgba.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.h); ++y)
    std::copy_n(picture.rgba.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                bottom_first_.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
  texture_.uploadPicture(std::as_bytes(std::span(bottom_first_)));
  showPictureOnWindow(texture_, place);
}

}  // namespace render
