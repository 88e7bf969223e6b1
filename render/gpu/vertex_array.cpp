#include "render/gpu/vertex_array.h"

#include <epoxy/gl.h>

namespace render {

GlName newVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return {name, [](unsigned gone) { glDeleteVertexArrays(1, &gone); }};
}

}  // namespace render
