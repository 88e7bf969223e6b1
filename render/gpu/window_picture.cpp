#include "render/gpu/window_picture.h"

#include <epoxy/gl.h>

namespace render {

// Framebuffer objects are not shared between contexts: this one lives for one copy.
void showPictureOnWindow(const Texture& picture, glm::ivec2 window_size, WindowBuffer buffer) {
  GLuint from = 0;
  glCreateFramebuffers(1, &from);
  glNamedFramebufferTexture(from, GL_COLOR_ATTACHMENT0, picture.name(), 0);
  const glm::ivec2 size = picture.size();
  const GLenum to = buffer == WindowBuffer::back_left    ? GL_BACK_LEFT
                    : buffer == WindowBuffer::back_right ? GL_BACK_RIGHT
                                                         : GL_BACK;
  glNamedFramebufferDrawBuffer(0, to);
  glBlitNamedFramebuffer(from, 0, 0, 0, size.x, size.y, 0, 0, window_size.x, window_size.y, GL_COLOR_BUFFER_BIT,
                         window_size == size ? GL_NEAREST : GL_LINEAR);
  glNamedFramebufferDrawBuffer(0, GL_BACK);
  glDeleteFramebuffers(1, &from);
}

}  // namespace render
