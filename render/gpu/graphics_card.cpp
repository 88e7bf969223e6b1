#include "render/gpu/graphics_card.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace render {

GraphicsCard currentGraphicsCard() {
  const GLubyte* const name = glGetString(GL_RENDERER);
  const GLubyte* const version = glGetString(GL_VERSION);
  GraphicsCard card{name != nullptr ? reinterpret_cast<const char*>(name) : "unknown",
                    version != nullptr ? reinterpret_cast<const char*>(version) : "unknown"};
  constexpr std::array<std::string_view, 5> kPrograms{"llvmpipe", "softpipe", "swrast", "Software Rasterizer",
                                                      "SwiftShader"};
  card.is_software = std::ranges::any_of(
      kPrograms, [&](std::string_view program) { return card.name.find(program) != std::string::npos; });
  return card;
}

}  // namespace render
