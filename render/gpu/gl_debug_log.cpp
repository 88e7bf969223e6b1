#include "render/gpu/gl_debug_log.h"

#include <epoxy/gl.h>

#include "render/gpu/gpu_error.h"

#if defined(__SANITIZE_ADDRESS__)
// Graphics drivers keep memory for the life of the process and unload what pointed to it: not for the leak checker.
// NOLINTNEXTLINE: the name is the sanitizer's.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
#endif

namespace render {
namespace {

void GLAPIENTRY keepFirstError(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void* user) {
  if (type != GL_DEBUG_TYPE_ERROR) return;
  auto& text = *static_cast<std::string*>(const_cast<void*>(user));
  if (text.empty()) text = message;
}

}  // namespace

GlDebugLog::GlDebugLog(bool listen) : listening_(listen) {
  if (!listening_) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&keepFirstError, &first_error_);
}

GlDebugLog::~GlDebugLog() {
  if (listening_) glDebugMessageCallback(nullptr, nullptr);
}

void GlDebugLog::throwIfError(std::string_view where) {
  // Core since OpenGL 4.5; contexts that can not be lost say so by never reporting it.
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw ContextLost("the graphics card was reset, " + std::string(where) + ": its driver gave up; draw anew");
  const GLenum code = glGetError();
  if (code == GL_NO_ERROR && first_error_.empty()) return;
  std::string text = "OpenGL error " + std::to_string(code) + ", " + std::string(where) + ": " +
                     (first_error_.empty() ? "see the driver's log" : first_error_) + "; update the graphics driver";
  for (char& c : text)
    if (c == '\n') c = ' ';
  first_error_.clear();
  throw GpuError(text);
}

}  // namespace render
