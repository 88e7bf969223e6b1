// The windows of a display mode, or of a fallback mode if that one is not available, which is reported in one line.
// Outputs go into one window, the two buffers of a stereo window, or two windows on two monitors. Main thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/text/message.h"
#include "render/display/display_mode.h"
#include "render/display/window.h"
#include "render/gpu/frame_fence.h"
#include "render/gpu/window_target.h"

namespace app {

class DisplayWindows {
 public:
  /// Puts an output into the current window.
  using ShowOutput = std::function<void(const render::WindowTarget& place, int output)>;

  struct Options {
    render::DisplayMode mode = render::DisplayMode::mono;
    glm::ivec2 screen_px{1280, 800};  ///< the rig's
    bool full_screen = false;
    std::optional<int> monitor = std::nullopt;  ///< index; two windows take this one and the next
  };

  /// Throws GpuError if no window can be opened.
  DisplayWindows(const Options& options, const ReportLine& report);
  ~DisplayWindows();

  render::DisplayMode mode() const { return mode_; }
  render::Window& first() { return *first_; }
  /// Of all windows.
  std::vector<render::WindowEvent> takeEvents();

  /// Draws all outputs and presents the right eye's window; afterwards the first window's context is current.
  void fill(const ShowOutput& show);

 private:
  void fallBack(render::DisplayMode mode, const std::string& because, const ReportLine& report);
  void openSecond(const Options& options, const ReportLine& report);

  render::DisplayMode mode_;
  std::unique_ptr<render::Window> first_, second_;  // the second shares with the first
  render::FrameFence drawn_;
};

}  // namespace app
