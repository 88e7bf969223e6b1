// A vertex array object of OpenGL: how the vertices of a drawing lie in their buffers. The thread of its context.
#pragma once

#include "render/gpu/gl_name.h"

namespace render {

/// Empty.
GlName newVertexArray();

}  // namespace render
