// Settings fixed for the life of a renderer. Those that may change with every frame are in Frame.
#pragma once

namespace render {

enum class Backend { gl_fragment, gl_compute, cpu };

struct RenderOptions {
  Backend backend = Backend::gl_fragment;
  int samples = 1;               ///< samples along each edge of a pixel; 2 for snapshots
  bool skip_empty_space = true;  ///< false: sample everything, for tests
};

}  // namespace render
