#include "render/gpu/gl_name.h"

#include <epoxy/gl.h>

namespace render {

GlName newBuffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return {name, [](unsigned gone) { glDeleteBuffers(1, &gone); }};
}

GlName newFramebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return {name, [](unsigned gone) { glDeleteFramebuffers(1, &gone); }};
}

GlName newTexture(unsigned target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return {name, [](unsigned gone) { glDeleteTextures(1, &gone); }};
}

GlName newVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return {name, [](unsigned gone) { glDeleteVertexArrays(1, &gone); }};
}

}  // namespace render
