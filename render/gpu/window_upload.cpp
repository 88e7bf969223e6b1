#include "render/gpu/window_upload.h"

#include "render/gpu/window_image.h"

namespace render {

void WindowUpload::show(const Image& image, WindowTarget place) {
  const glm::ivec2 size(image.w, image.h);
  if (glm::ivec2(texture_.size()) != size) texture_ = Texture::image(size, TexelFormat::rgba8);
  texture_.uploadImage(std::as_bytes(std::span(image.rgba)));
  place.flipped_y = !place.flipped_y;  // its rows come top first
  showImageOnWindow(texture_, place);
}

}  // namespace render
