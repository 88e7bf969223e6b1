#include "render/gpu/window_upload.h"

#include "render/gpu/window_picture.h"

namespace render {

void WindowUpload::show(const Picture& picture, WindowPlace place) {
  const glm::ivec2 size(picture.w, picture.h);
  if (glm::ivec2(texture_.size()) != size) texture_ = Texture::picture(size, TexelFormat::rgba8);
  texture_.uploadPicture(std::as_bytes(std::span(picture.rgba)));
  place.flipped_y = !place.flipped_y;  // its rows come top first
  showPictureOnWindow(texture_, place);
}

}  // namespace render
