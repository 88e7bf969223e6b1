// The surgeon's display: the windows of a display mode, or none when headless, and the renderer that draws into them.
// Falls back to the next best mode or renderer, reported in one line, and recreates everything after a reset of the
// graphics card. At most one frame is queued: show() returns when it was presented, and waitUntilShown() is called
// before the next pose is read. Main thread.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/view/display_windows.h"
#include "render/frame_renderer.h"
#include "render/gpu/frame_fence.h"
#include "render/gpu/offscreen_context.h"

namespace app {

class SurgeonDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  using MakeRenderer = std::function<std::unique_ptr<render::FrameRenderer>(render::Backend)>;

  struct Options {
    DisplayWindows::Options windows;
    bool eyes_swapped = false;
    std::optional<render::Backend> backend = std::nullopt;  ///< empty: what suits the machine
    bool headless = false;
    bool needs_window = true;  ///< the mouse is the pose source: headless is no fallback
  };

  /// `make_renderer` is called with the context current: for the first frame, and again after a reset. Throws
  /// GpuError when nothing can be opened.
  /// `windows`: opened before with the same options, or null.
  SurgeonDisplay(const Options& options, MakeRenderer make_renderer, ReportLine report,
                 std::unique_ptr<DisplayWindows> windows = nullptr);
  ~SurgeonDisplay();

  /// Draws and presents. Sets the frame's display mode, eye order and, on interleaved displays, size. Recreates
  /// everything after a reset of the graphics card; throws ContextLost at the fourth.
  void show(render::Frame frame);
  /// Presents the picture shown last with the newest overlay; the frame is drawn only where that is not possible (a
  /// resized interleaved display, a reset of the graphics card).
  void showAgain(const render::Frame& frame);
  /// The first output of the frame as show() would draw it, not presented. Throws GpuError.
  render::Image picture(render::Frame frame);
  /// Until the GPU has presented the newest frame.
  void waitUntilShown();

  /// Time of drawing the newest frame that was drawn, without waiting for the display, s.
  double drawing_s() const { return drawing_s_; }
  /// Latest known time of presenting the newest frame.
  Clock::time_point presentedAt() const { return presented_at_; }

  /// Size of the image that a frame with this rig gets: interleaved displays draw the window's own pixels.
  glm::ivec2 imageSize_px(const calibration::Rig& rig);
  render::DisplayMode mode() const { return windows_ ? windows_->mode() : options_.windows.mode; }
  render::Backend backend() const { return *options_.backend; }
  /// By its own renderer, or because OpenGL runs on it (Mesa's llvmpipe).
  bool drawsOnProcessor() const { return draws_on_processor_; }
  /// Null: headless.
  render::Window* window() { return windows_ ? &windows_->first() : nullptr; }
  std::vector<render::WindowEvent> takeEvents() {
    return windows_ ? windows_->takeEvents() : std::vector<render::WindowEvent>{};
  }
  /// Made at the first call. Throws GpuError if the CPU renderer fails too.
  render::FrameRenderer& renderer();
  /// A second one in the same context; falls back from compute to fragment shaders to CPU.
  std::unique_ptr<render::FrameRenderer> newRenderer(const MakeRenderer& make);
  double refresh_Hz() { return windows_ ? windows_->first().refresh_Hz() : 60.0; }
  /// Number of resets so far.
  int contextLosses() const { return context_losses_; }
  /// Called before the windows are closed for a reset: objects sharing their context must be destroyed first.
  void beforeRecreation(std::function<void()> call) { before_recreation_ = std::move(call); }
  /// As after a reset of the graphics card.
  void recreate();
  /// Makes the surgeon's context current.
  void makeCurrent();

 private:
  void open();
  void openOffscreen();
  void prepare(render::Frame& frame);
  void drawAndPresent(const render::Frame& frame);
  void fillWindows();
  void present();
  void close();

  Options options_;
  MakeRenderer make_renderer_;
  ReportLine report_;
  std::function<void()> before_recreation_;
  std::optional<render::OffscreenContext> offscreen_;
  std::unique_ptr<DisplayWindows> windows_;
  std::unique_ptr<render::FrameRenderer> renderer_;
  std::optional<render::FrameFence> fence_;
  Clock::time_point presented_at_{};
  std::optional<std::pair<glm::ivec2, glm::ivec2>> shown_px_;  ///< size and place of the newest image on the panel
  double drawing_s_ = 0.0;
  int context_losses_ = 0;
  bool draws_on_processor_ = false;
};

}  // namespace app
