// Listens to KHR_debug in a context made with debugging and turns the first error heard into a GpuError; in any context
// glGetError is asked as well. Cost of throwIfError: one driver call. Thread: the context's.
#pragma once

#include <string>
#include <string_view>

namespace render {

class GlDebugLog {
 public:
  /// `listen`: install the callback (debug contexts); the context must be current.
  explicit GlDebugLog(bool listen);
  ~GlDebugLog();
  GlDebugLog(const GlDebugLog&) = delete;
  GlDebugLog& operator=(const GlDebugLog&) = delete;

  /// Throws GpuError naming `where` if an OpenGL error happened since the last call, ContextLost after a reset.
  void throwIfError(std::string_view where);

 private:
  bool listening_;
  std::string first_error_;
};

}  // namespace render
