// The renderer of the current OpenGL context: name, version, and whether it runs on the CPU (Mesa's llvmpipe and
// softpipe, SwiftShader). Thread: the context's; a driver call.
#pragma once

#include <string>

namespace render {

struct GraphicsCard {
  std::string name, version = {};  ///< version: of OpenGL, as the driver writes it
  bool is_software = false;
};

GraphicsCard currentGraphicsCard();

}  // namespace render
