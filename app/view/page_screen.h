// Shows images drawn on the CPU in the windows of a display mode, at the windows' own pixels. Main thread, with the
// first window's context current.
#pragma once

#include <functional>
#include <vector>

#include "app/view/display_windows.h"
#include "render/display/stereo_layout.h"
#include "render/gpu/window_image.h"
#include "render/image.h"

namespace app {

class PageScreen {
 public:
  /// Borrows the windows, which must outlive it. `screen_px`: the rig's.
  PageScreen(DisplayWindows& windows, glm::ivec2 screen_px, bool eyes_swapped)
      : windows_(windows), screen_px_(screen_px), swapped_(eyes_swapped) {}

  /// Shows the image of `draw` for each output; waits for the display. `as_the_panel`: drawn in the panel's pixels
  /// regardless of the window, for a camera's patterns.
  void show(const std::function<render::Image(const render::StereoLayout&)>& draw, bool as_the_panel = false);

 private:
  DisplayWindows& windows_;
  glm::ivec2 screen_px_;
  bool swapped_;
  render::WindowUpload upload_[2];
};

}  // namespace app
