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

// Framebuffer objects are not shared between contexts: this one lives for one copy.
void showImageOnWindow(const Texture& image, const WindowTarget& place) {
  const GlName from = newFramebuffer();
  glNamedFramebufferTexture(from.get(), GL_COLOR_ATTACHMENT0, image.name(), 0);
  const glm::ivec2 size = image.size();
  glm::ivec2 low = place.corner_px, high = low + place.size_px;
  if (place.flipped_x) std::swap(low.x, high.x);
  if (place.flipped_y) std::swap(low.y, high.y);
  glNamedFramebufferDrawBuffer(0, nameOf(place.buffer));
  glBlitNamedFramebuffer(from.get(), 0, 0, 0, size.x, size.y, low.x, low.y, high.x, high.y, GL_COLOR_BUFFER_BIT,
                         place.size_px == size ? GL_NEAREST : GL_LINEAR);
  glNamedFramebufferDrawBuffer(0, GL_BACK);
}

void clearWindow(WindowBuffer buffer) {
  const std::array<float, 4> black{0.0f, 0.0f, 0.0f, 1.0f};
  glNamedFramebufferDrawBuffer(0, nameOf(buffer));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearNamedFramebufferfv(0, GL_COLOR, 0, black.data());
  glNamedFramebufferDrawBuffer(0, GL_BACK);
}

}  // namespace render
