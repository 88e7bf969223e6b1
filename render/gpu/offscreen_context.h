// An OpenGL 4.5 core context without window or X: EGL on the first graphics card that provides one, else on Mesa's
// surfaceless platform, else on the default display. Current on the constructing thread from construction to
// destruction. Cost: some ten ms. No quad-buffered stereo.
#pragma once

namespace render {

class OffscreenContext {
 public:
  /// Throws GpuError if no OpenGL 4.5 is available.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Makes it current on the calling thread; it must not be current on another.
  void makeCurrent();

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace render
