// The shaders of render/shaders, embedded at build with their includes resolved. Any thread; a look-up in a short list.
#pragma once

#include <string_view>

namespace render {

/// GLSL text of a shader by file name ("volume.frag"); throws GpuError for a name that was not built in.
std::string_view shaderSource(std::string_view name);

}  // namespace render
