// The display of a calibration: windows in their display mode, filled with images drawn on the CPU at the window's own
// pixels. Main thread. Throws GpuError without a display.
#pragma once

#include <functional>
#include <vector>

#include "app/view/display_windows.h"
#include "app/view/page_screen.h"

namespace app {

struct WizardDisplay {
  render::DisplayMode mode = render::DisplayMode::mono;
  bool swapped = false;  ///< the eyes
  bool full_screen = true;
  std::optional<int> monitor = std::nullopt;  ///< index
};

class WizardScreen {
 public:
  /// `screen_px`: the rig's. `report`: called with the fallback if the display mode is not available.
  WizardScreen(const WizardDisplay& display, glm::ivec2 screen_px, const ReportLine& report);

  std::vector<render::WindowEvent> takeEvents() { return windows_.takeEvents(); }
  glm::ivec2 window_px() { return windows_.first().framebufferSize_px(); }

  /// PageScreen::show().
  void show(const std::function<render::Image(const render::StereoLayout&)>& draw, bool as_the_panel = false) {
    screen_.show(draw, as_the_panel);
  }

 private:
  DisplayWindows windows_;
  PageScreen screen_;  // textures: before the windows go
};

}  // namespace app
