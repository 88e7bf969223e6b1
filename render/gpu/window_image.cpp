#include "render/gpu/window_image.h"

#include <epoxy/gl.h>

#include <array>
#include <utility>

namespace render {
namespace {

GLenum nameOf(WindowBuffer buffer) {
  if (buffer == WindowBuffer::back_left) return GL_BACK_LEFT;
  return buffer == WindowBuffer::back_right ? GL_BACK_RIGHT : GL_BACK;
}

}  // namespace

// Framebuffer objects are not shared between contexts, so one is created for each copy.
void showImageOnWindow(const Texture& image, const WindowTarget& target) {
  const GlName from = newFramebuffer();
  glNamedFramebufferTexture(from.get(), GL_COLOR_ATTACHMENT0, image.name(), 0);
  const glm::ivec2 size = image.size();
  glm::ivec2 low = target.corner_px, high = low + target.size_px;
  if (target.flipped_x) std::swap(low.x, high.x);
  if (target.flipped_y) std::swap(low.y, high.y);
  // Bound, not only named: Mesa takes up the buffers of a window after a swap when it is bound.
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glNamedFramebufferDrawBuffer(0, nameOf(target.buffer));
  glBlitNamedFramebuffer(from.get(), 0, 0, 0, size.x, size.y, low.x, low.y, high.x, high.y, GL_COLOR_BUFFER_BIT,
                         target.size_px == size ? GL_NEAREST : GL_LINEAR);
  glNamedFramebufferDrawBuffer(0, GL_BACK);
}

void clearWindow(WindowBuffer buffer) {
  const std::array<float, 4> black{0.0f, 0.0f, 0.0f, 1.0f};
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glNamedFramebufferDrawBuffer(0, nameOf(buffer));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearNamedFramebufferfv(0, GL_COLOR, 0, black.data());
  glNamedFramebufferDrawBuffer(0, GL_BACK);
}

void WindowUpload::show(const Image& image, WindowTarget target) {
  const glm::ivec2 size(image.w, image.h);
  if (glm::ivec2(texture_.size()) != size) texture_ = Texture::image(size, TexelFormat::rgba8);
  texture_.uploadImage(std::as_bytes(std::span(image.rgba)));
  target.flipped_y = !target.flipped_y;  // its top row is first
  showImageOnWindow(texture_, target);
}

}  // namespace render
