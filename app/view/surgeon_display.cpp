#include "app/view/surgeon_display.h"

#include "app/text/elapsed.h"
#include "app/view/renderer_choice.h"
#include "render/display/stereo_layout.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"

namespace app {
namespace {

using render::Backend;

constexpr int kMaxResets = 3;  ///< of the graphics card, in one rehearsal

}  // namespace

SurgeonDisplay::SurgeonDisplay(const Options& options, MakeRenderer make_renderer, ReportLine report,
                               std::unique_ptr<DisplayWindows> windows)
    : options_(options),
      make_renderer_(std::move(make_renderer)),
      report_(std::move(report)),
      windows_(std::move(windows)) {
  open();
}

SurgeonDisplay::~SurgeonDisplay() { close(); }

void SurgeonDisplay::open() {
  if (!options_.headless && !windows_) {
    try {
      windows_ = std::make_unique<DisplayWindows>(options_.windows, report_);
    } catch (const render::GpuError& error) {
      if (options_.needs_window) throw;
      report_(std::string(error.what()) + "; going on without a window");
      options_.headless = true;
    }
  }
  if (options_.headless)
    openOffscreen();
  else
    options_.backend = rendererForWindow(options_.backend, report_);
  draws_on_processor_ = options_.backend == Backend::cpu || render::currentGraphicsCard().is_software;
  fence_.emplace();
}

void SurgeonDisplay::openOffscreen() {
  try {
    options_.backend = rendererWithoutWindow(options_.backend, offscreen_, report_);
  } catch (const render::GpuError& error) {
    report_(std::string(error.what()) + "; drawing on the processor");
    options_.backend = Backend::cpu;
  }
}

render::FrameRenderer& SurgeonDisplay::renderer() {
  if (!renderer_) renderer_ = newRenderer(make_renderer_);
  return *renderer_;
}

std::unique_ptr<render::FrameRenderer> SurgeonDisplay::newRenderer(const MakeRenderer& make) {
  for (;;) {
    try {
      return make(*options_.backend);
    } catch (const render::ContextLost&) {
      throw;
    } catch (const render::GpuError& error) {
      if (options_.backend == Backend::cpu) throw;
      const bool compute = options_.backend == Backend::gl_compute;
      report_(std::string(error.what()) + (compute ? "; drawing with fragment shaders" : "; drawing on the processor"));
      options_.backend = compute ? Backend::gl_fragment : Backend::cpu;
    }
  }
}

void SurgeonDisplay::close() {
  makeCurrent();
  fence_.reset();
  renderer_.reset();
  windows_.reset();
  offscreen_.reset();
}

void SurgeonDisplay::recreate() {
  if (before_recreation_) before_recreation_();
  close();
  open();
}

void SurgeonDisplay::makeCurrent() {
  if (windows_) windows_->first().makeCurrent();
}

glm::ivec2 SurgeonDisplay::imageSize_px(const calibration::Rig& rig) {
  const glm::ivec2 window_px = window() != nullptr ? window()->framebufferSize_px() : glm::ivec2(0);
  return render::isInterleaved(mode()) && window_px.x > 0 && window_px.y > 0 ? window_px : rig.screen.px;
}

void SurgeonDisplay::prepare(render::Frame& frame) {
  frame.display = mode();
  frame.eyes_swapped = options_.eyes_swapped;
  if (window() == nullptr) return;
  // Scaling would mix the eyes' lines.
  frame.rig.screen.px = imageSize_px(frame.rig);
  if (render::isInterleaved(mode())) frame.output_at_px = window()->positionOnPanel_px();
}

render::Image SurgeonDisplay::picture(render::Frame frame) {
  prepare(frame);
  renderer().render(frame);
  renderer_->throwIfError();
  return renderer_->readImage();
}

void SurgeonDisplay::show(render::Frame frame) {
  if (window() != nullptr) {
    const glm::ivec2 window_px = window()->framebufferSize_px();
    if (window_px.x <= 0 || window_px.y <= 0) return;  // minimised
  }
  prepare(frame);
  for (;;) {
    try {
      return drawAndPresent(frame);
    } catch (const render::ContextLost& lost) {
      if (context_losses_ == kMaxResets) throw;
      ++context_losses_;
      report_(std::string(lost.what()) + "; all is created again");
      recreate();
    }
  }
}

void SurgeonDisplay::drawAndPresent(const render::Frame& frame) {
  const Clock::time_point begun = Clock::now();
  renderer().render(frame);
  shown_px_ = {frame.rig.screen.px, frame.output_at_px};
  fillWindows();
  drawing_s_ = secondsBetween(begun, Clock::now());
  present();
}

void SurgeonDisplay::showAgain(const render::Frame& frame) {
  render::Frame prepared = frame;
  prepare(prepared);
  if (!renderer_ || shown_px_ != std::pair(prepared.rig.screen.px, prepared.output_at_px)) return show(frame);
  try {
    renderer_->composeAgain();
    fillWindows();
    present();
  } catch (const render::ContextLost&) {
    show(frame);  // finds it lost as well, and creates all again
  }
}

/// What drawing costs is known before the display is waited for.
void SurgeonDisplay::fillWindows() {
  if (windows_) {
    windows_->fill([this](const render::WindowTarget& place, int output) { renderer_->showOnWindow(place, output); });
    fence_->mark();
    fence_->wait();
  } else {
    renderer_->readImage();
  }
}

void SurgeonDisplay::present() {
  renderer_->throwIfError();
  if (windows_) {
    windows_->first().present();
    fence_->mark();
  }
  presented_at_ = Clock::now();
}

void SurgeonDisplay::waitUntilShown() {
  if (!windows_) return;
  fence_->wait();
  presented_at_ = Clock::now();
}

}  // namespace app
