// OpenGL errors as GpuError. Cost: two driver calls. Thread: the context's.
#pragma once

#include <string_view>

namespace render {

/// Throws GpuError naming `where` if an OpenGL error occurred since the last call, ContextLost after a reset.
void throwIfGlError(std::string_view where);

}  // namespace render
