// What the surgeon looks at: the window or windows of a display mode, or none when headless, and the renderer that
// draws into them. Opens the next best where the mode asked for can not be had, and says so in one line; makes
// everything anew after the graphics card was reset. At most one picture is ever on its way: show() returns when it was
// handed over, and waitUntilShown() comes before the hand is asked for its next pose. Main thread.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/view/context_recovery.h"
#include "app/view/display_windows.h"
#include "render/frame_renderer.h"
#include "render/gpu/frame_fence.h"
#include "render/gpu/offscreen_context.h"

namespace app {

class SurgeonDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  using MakeRenderer = std::function<std::unique_ptr<render::FrameRenderer>(render::Backend)>;
  using ReportLine = DisplayWindows::ReportLine;

  struct Options {
    DisplayWindows::Options windows;
    bool eyes_swapped = false;
    std::optional<render::Backend> backend = std::nullopt;  ///< empty: what suits the machine
    bool headless = false;
    bool needs_window = true;  ///< the hand is the mouse: without a display there is nothing to do
  };

  /// `make_renderer` is called with the context current: for the first picture, and again after a reset. Throws
  /// GpuError when nothing can be opened.
  SurgeonDisplay(const Options& options, MakeRenderer make_renderer, ReportLine report);
  ~SurgeonDisplay();

  /// Draws and hands over. The frame's display, parity and, on interleaved displays, size are this one's.
  void show(render::Frame frame);
  /// Until the graphics card has handed over the newest picture.
  void waitUntilShown();

  /// How long the newest frame took to draw, without waiting for the display, s.
  double drawing_s() const { return drawing_s_; }
  /// When the newest picture was handed over, as far as is known.
  Clock::time_point presentedAt() const { return presented_at_; }

  render::DisplayMode mode() const { return windows_ ? windows_->mode() : options_.windows.mode; }
  render::Backend backend() const { return *options_.backend; }
  /// None: headless.
  render::Window* window() { return windows_ ? &windows_->first() : nullptr; }
  /// Of all its windows.
  std::vector<render::WindowEvent> takeEvents() {
    return windows_ ? windows_->takeEvents() : std::vector<render::WindowEvent>{};
  }
  /// Made when it is first asked for. Throws GpuError when not even the processor can.
  render::FrameRenderer& renderer();
  /// Another one, in the same context; of what the driver does not take the next best.
  std::unique_ptr<render::FrameRenderer> newRenderer(const MakeRenderer& make);
  double refresh_Hz() { return windows_ ? windows_->first().refresh_Hz() : 60.0; }
  /// How often everything was made anew.
  int contextLosses() const { return recovery_.contextLosses(); }
  /// Called before windows are closed to be made anew: what shares with them must go first.
  void beforeRecreation(std::function<void()> call) { before_recreation_ = std::move(call); }
  /// As after a reset of the graphics card.
  void recreate();
  /// The next drawing belongs to the surgeon's context again.
  void makeCurrent();

 private:
  void open();
  void openOffscreen();
  void drawAndPresent(render::Frame& frame);
  void close();

  Options options_;
  MakeRenderer make_renderer_;
  ReportLine report_;
  std::function<void()> before_recreation_;
  std::optional<render::OffscreenContext> offscreen_;
  std::optional<DisplayWindows> windows_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  std::optional<render::FrameFence> fence_;
  Clock::time_point presented_at_{};
  double drawing_s_ = 0.0;
  ContextRecovery recovery_;
};

}  // namespace app
