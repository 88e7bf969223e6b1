// An OpenGL 4.5 core context without window or X: EGL on the first graphics card it can be had on, else on Mesa's
// surfaceless platform, else on the default display. Current on the constructing thread from construction to
// destruction. Cost: some ten ms.
// Not for quad-buffered stereo.
#pragma once

namespace render {

class OffscreenContext {
 public:
  /// Throws GpuError when no OpenGL 4.5 can be had.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Makes it current on the calling thread, after it was current on no other or a window was opened.
  void makeCurrent();

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace render
