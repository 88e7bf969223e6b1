// What is chosen once for a renderer. What may change with every frame is in Frame.
#pragma once

namespace render {

enum class Backend { gl_fragment, gl_compute, cpu };

struct RenderOptions {
  Backend backend = Backend::gl_fragment;
  int samples = 1;               ///< along each edge of a pixel; 2 for snapshots
  bool skip_empty_space = true;  ///< false marches through everything, for tests
};

}  // namespace render
