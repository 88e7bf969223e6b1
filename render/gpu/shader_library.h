// The shaders of render/shaders, embedded at build with their includes resolved. Any thread; searches a short list.
#pragma once

#include <string_view>

namespace render {

/// GLSL text of a shader by file name ("volume.frag"); throws GpuError for an unknown name.
std::string_view shaderSource(std::string_view name);

}  // namespace render
