#include "render/gpu/gpu_error.h"

#include <epoxy/gl.h>

#include <string>

#if defined(__SANITIZE_ADDRESS__)
// Graphics drivers keep memory for the life of the process and unload the code that referenced it.
// NOLINTNEXTLINE: the name is the sanitizer's.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif

namespace render {

void throwIfGlError(std::string_view where) {
  // Core since OpenGL 4.5; never set in contexts without reset notification.
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw ContextLost("the graphics card was reset, " + std::string(where) + "; restart the program");
  if (const GLenum code = glGetError(); code != GL_NO_ERROR)
    throw GpuError("OpenGL error " + std::to_string(code) + ", " + std::string(where) +
                   ": see the driver's log; update the graphics driver");
}

}  // namespace render
