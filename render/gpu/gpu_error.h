// Exceptions of render: no display, no driver, a shader that does not build, an invalid camera. The text is one line:
// what, where, what to do.
#pragma once

#include <stdexcept>
#include <string_view>

namespace render {

struct GpuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The graphics card was reset: the context is lost; windows and renderers must be created again.
struct ContextLost : GpuError {
  using GpuError::GpuError;
};

/// Throws GpuError naming `where` if an OpenGL error occurred since the last call, ContextLost after a reset. Thread:
/// the context's; two driver calls.
void throwIfGlError(std::string_view where);

}  // namespace render
