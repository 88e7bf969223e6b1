#include "app/surgeon_display.h"

#include <utility>

#include "app/renderer_choice.h"
#include "render/display/stereo_layout.h"
#include "render/gpu/gpu_error.h"

namespace app {
namespace {

using render::Backend;
using render::DisplayMode;

constexpr int kMostResets = 3;  ///< a driver that gives up again and again is not worth another window

double secondsBetween(SurgeonDisplay::Clock::time_point from, SurgeonDisplay::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

std::string nameText(DisplayMode mode) { return std::string(render::nameOf(mode)); }

std::string sizeText(glm::ivec2 px) { return std::to_string(px.x) + "x" + std::to_string(px.y); }

}  // namespace

SurgeonDisplay::SurgeonDisplay(const Options& options, MakeRenderer make_renderer, Tell tell)
    : options_(options), make_renderer_(std::move(make_renderer)), tell_(std::move(tell)) {
  open();
}

SurgeonDisplay::~SurgeonDisplay() { close(); }

void SurgeonDisplay::open() {
  if (!options_.headless) {
    try {
      openWindows();
    } catch (const render::GpuError& error) {
      if (options_.needs_window) throw;
      tell_(std::string(error.what()) + "; going on without a window");
      options_.headless = true;
      windows_ = {};
    }
  }
  if (options_.headless)
    openOffscreen();
  else
    options_.backend = rendererForWindow(options_.backend, tell_);
  fence_.emplace();
  openRenderer();
}

void SurgeonDisplay::openOffscreen() {
  try {
    options_.backend = rendererWithoutWindow(options_.backend, offscreen_, tell_);
  } catch (const render::GpuError& error) {
    tell_(std::string(error.what()) + "; drawing on the processor");
    options_.backend = Backend::cpu;
  }
}

/// A driver that does not take the shaders: the next best renderer.
void SurgeonDisplay::openRenderer() {
  while (!renderer_) {
    try {
      renderer_ = make_renderer_(*options_.backend);
    } catch (const render::GpuError& error) {
      if (options_.backend == Backend::cpu) throw;
      const bool compute = options_.backend == Backend::gl_compute;
      tell_(std::string(error.what()) + (compute ? "; drawing with fragment shaders" : "; drawing on the processor"));
      options_.backend = compute ? Backend::gl_fragment : Backend::cpu;
    }
  }
}

void SurgeonDisplay::insteadShow(DisplayMode mode, const std::string& because) {
  tell_("--display " + nameText(options_.mode) + ": " + because + "; showing " + nameText(mode));
  options_.mode = mode;
}

void SurgeonDisplay::openWindows() {
  const auto here = render::monitors();
  const std::size_t wanted_monitor = static_cast<std::size_t>(options_.monitor.value_or(0));
  // Two full screens need two monitors; both eyes on one of them are halves.
  if (options_.mode == DisplayMode::two_windows && options_.full_screen && wanted_monitor + 1 >= here.size())
    insteadShow(DisplayMode::side_by_side, "there is one monitor only");
  // A packed frame is a video mode of its own; scaled to another it is no frame. What packs takes halves as well.
  if (options_.mode == DisplayMode::frame_packing && options_.full_screen && wanted_monitor < here.size() &&
      here[wanted_monitor].px != render::outputSize(options_.mode, options_.screen_px))
    insteadShow(DisplayMode::top_bottom, "the monitor is set to " + sizeText(here[wanted_monitor].px) +
                                             ", not to the packed mode " +
                                             sizeText(render::outputSize(options_.mode, options_.screen_px)));

  render::Window::Options first;
  first.full_screen = options_.full_screen;
  first.monitor = options_.monitor;
  first.quad_buffer = options_.mode == DisplayMode::quad_buffer;
  first.size_px = render::outputSize(options_.mode, options_.screen_px);
  try {
    windows_[0] = std::make_unique<render::Window>(first);
  } catch (const render::GpuError& error) {
    if (!first.quad_buffer) throw;
    insteadShow(DisplayMode::mono, error.what());
    first.quad_buffer = false;
    windows_[0] = std::make_unique<render::Window>(first);
  }
  if (options_.mode == DisplayMode::two_windows) openSecondWindow();
}

void SurgeonDisplay::openSecondWindow() {
  render::Window::Options second;
  second.title = "Molar, right eye";
  second.full_screen = options_.full_screen;
  if (render::monitors().size() > 1) second.monitor = options_.monitor.value_or(0) + 1;
  second.size_px = options_.screen_px;
  second.focused = false;
  second.beside = windows_[0].get();
  try {
    windows_[1] = std::make_unique<render::Window>(second);
  } catch (const render::GpuError& error) {
    insteadShow(DisplayMode::mono, error.what());
  }
  windows_[0]->makeCurrent();
}

void SurgeonDisplay::close() {
  if (windows_[0]) windows_[0]->makeCurrent();
  fence_.reset();
  renderer_.reset();
  windows_[1].reset();
  windows_[0].reset();
  offscreen_.reset();
}

void SurgeonDisplay::makeAnew() {
  close();
  open();
}

void SurgeonDisplay::makeCurrent() {
  if (windows_[0]) windows_[0]->makeCurrent();
}

void SurgeonDisplay::show(render::Frame frame) {
  frame.display = options_.mode;
  frame.eyes_swapped = options_.eyes_swapped;
  if (window() != nullptr) {
    const glm::ivec2 window_px = window()->framebufferSize_px();
    if (window_px.x <= 0 || window_px.y <= 0) return;  // minimised
    // Scaling would mix the eyes' lines.
    if (render::isInterleaved(options_.mode)) {
      frame.rig.screen.px = window_px;
      frame.output_at_px = window()->placeOnPanel_px();
    }
  }
  try {
    drawAndPresent(frame);
  } catch (const render::ContextLost& lost) {
    if (++times_lost_ > kMostResets) throw;
    tell_(std::string(lost.what()) + "; everything is drawn anew");
    makeAnew();
    drawAndPresent(frame);
  }
}

void SurgeonDisplay::drawAndPresent(render::Frame& frame) {
  const Clock::time_point begun = Clock::now();
  renderer_->render(frame);
  if (!windows_[0]) {
    renderer_->readPicture();
    handed_over_ = Clock::now();
    drawing_s_ = secondsBetween(begun, handed_over_);
    renderer_->throwIfError();
    return;
  }
  const glm::ivec2 size = windows_[0]->framebufferSize_px();
  if (options_.mode == DisplayMode::quad_buffer) {
    renderer_->showOnWindow({.size_px = size, .buffer = render::WindowBuffer::back_left}, 0);
    renderer_->showOnWindow({.size_px = size, .buffer = render::WindowBuffer::back_right}, 1);
  } else {
    renderer_->showOnWindow({.size_px = size});
  }
  // What drawing costs is known before the display is waited for.
  fence_->mark();
  if (windows_[1]) {
    windows_[1]->makeCurrent();
    fence_->follow();
    renderer_->showOnWindow({.size_px = windows_[1]->framebufferSize_px()}, 1);
    windows_[1]->present();
    windows_[0]->makeCurrent();
  }
  fence_->wait();
  drawing_s_ = secondsBetween(begun, Clock::now());
  renderer_->throwIfError();
  windows_[0]->present();
  fence_->mark();
  handed_over_ = Clock::now();
}

void SurgeonDisplay::waitUntilShown() {
  if (!windows_[0]) return;
  fence_->wait();
  handed_over_ = Clock::now();
}

}  // namespace app
