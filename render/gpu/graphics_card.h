// What draws in the current OpenGL context: its own name and version, and whether it is a program on the CPU (Mesa's
// llvmpipe and softpipe, SwiftShader). Thread: the context's; a driver call.
#pragma once

#include <string>

namespace render {

struct GraphicsCard {
  std::string name, version = {};  ///< version: of OpenGL, as the driver writes it
  bool is_software = false;
};

GraphicsCard currentGraphicsCard();

}  // namespace render
