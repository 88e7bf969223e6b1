#include "render/gpu/shader_library.h"

#include <string>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

struct EmbeddedShader {
  std::string_view name, text;
};

constexpr EmbeddedShader kShaders[] = {
#include "shader_sources.inc"
};

}  // namespace

std::string_view shaderSource(std::string_view name) {
  for (const EmbeddedShader& shader : kShaders)
    if (shader.name == name) return shader.text;
  throw GpuError("unknown shader, " + std::string(name) + ": list it in render/CMakeLists.txt");
}

}  // namespace render
