// The one exception of this folder: no display, no driver, a shader that does not build, a camera that can not be
// drawn. The text is one line: what, where, what to do.
#pragma once

#include <stdexcept>

namespace render {

struct GpuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace render
