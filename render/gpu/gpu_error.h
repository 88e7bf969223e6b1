// The one exception of this folder: no display, no driver, a shader that does not build, a camera that can not be
// drawn. The text is one line: what, where, what to do.
#pragma once

#include <stdexcept>

namespace render {

struct GpuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The graphics card was reset: context and all in it are gone; windows and renderers must be made anew.
struct ContextLost : GpuError {
  using GpuError::GpuError;
};

}  // namespace render
