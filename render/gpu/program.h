// A linked program of the shaders in render/shaders, which are embedded at build: vertex and fragment shader, or a
// compute shader. All inputs are uniform blocks and texture units with fixed bindings (shared_constants.glsl).
// Move-only. Thread: the context's. Cost: compiling, 0.1 to 0.5 s on a software rasteriser.
#pragma once

#include <initializer_list>
#include <string_view>

#include "render/gpu/gl_name.h"

namespace render {

class Program {
 public:
  /// File names ending in .vert, .frag or .comp. Throws GpuError for unknown names, and with the driver's message if
  /// they do not build.
  Program(std::initializer_list<std::string_view> files);

  void use() const;

 private:
  GlName name_;
};

}  // namespace render
