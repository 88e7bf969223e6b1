#include "app/view/display_windows.h"

#include <algorithm>

#include <fmt/core.h>

#include "render/display/stereo_layout.h"
#include "render/gpu/gpu_error.h"

namespace app {

using render::DisplayMode;

namespace {

/// A window of the same shape that fits on a smaller monitor with its frame.
glm::ivec2 withinMonitor(glm::ivec2 size_px, glm::ivec2 monitor_px) {
  const glm::dvec2 room = glm::dvec2(monitor_px) / glm::dvec2(size_px);
  const double scale = std::min(room.x, room.y);
  return scale < 1.0 && scale > 0.0 ? glm::ivec2(0.92 * scale * glm::dvec2(size_px)) : size_px;
}

}  // namespace

DisplayWindows::DisplayWindows(const Options& options, const ReportLine& report) : mode_(options.mode) {
  const auto here = render::monitors();
  const auto wanted = static_cast<std::size_t>(options.monitor.value_or(0));
  // Two full-screen windows need two monitors.
  if (mode_ == DisplayMode::two_windows && options.full_screen && wanted + 1 >= here.size())
    fallBack(DisplayMode::side_by_side, "there is only one monitor", report);
  // A packed frame needs its own video mode. Displays that unpack it accept top-bottom as well.
  const glm::ivec2 output_px = render::outputSize(mode_, options.screen_px);
  if (mode_ == DisplayMode::frame_packing && options.full_screen && wanted < here.size() &&
      here[wanted].px != output_px)
    fallBack(DisplayMode::top_bottom,
             fmt::format("the monitor is set to {}x{}, not to the packed mode {}x{}", here[wanted].px.x,
                         here[wanted].px.y, output_px.x, output_px.y),
             report);

  render::Window::Options first;
  first.full_screen = options.full_screen;
  first.monitor = options.monitor;
  first.quad_buffer = mode_ == DisplayMode::quad_buffer;
  first.size_px = render::outputSize(mode_, options.screen_px);
  if (mode_ == DisplayMode::mono && !options.full_screen && wanted < here.size())
    first.size_px = withinMonitor(first.size_px, here[wanted].px);
  try {
    first_ = std::make_unique<render::Window>(first);
  } catch (const render::GpuError& error) {
    if (!first.quad_buffer) throw;
    fallBack(DisplayMode::mono, error.what(), report);
    first.quad_buffer = false;
    first_ = std::make_unique<render::Window>(first);
  }
  if (mode_ == DisplayMode::two_windows) openSecond(options, report);
}

DisplayWindows::~DisplayWindows() = default;

void DisplayWindows::fallBack(DisplayMode mode, const std::string& because, const ReportLine& report) {
  report(fmt::format("--display {}: {}; showing {}", render::nameOf(mode_), because, render::nameOf(mode)));
  mode_ = mode;
}

void DisplayWindows::openSecond(const Options& options, const ReportLine& report) {
  render::Window::Options second;
  second.title = "Molar, right eye";
  second.full_screen = options.full_screen;
  if (render::monitors().size() > 1) second.monitor = options.monitor.value_or(0) + 1;
  second.size_px = options.screen_px;
  second.focused = false;
  second.share_with = first_.get();
  try {
    second_ = std::make_unique<render::Window>(second);
  } catch (const render::GpuError& error) {
    fallBack(DisplayMode::mono, error.what(), report);
  }
  first_->makeCurrent();
}

std::vector<render::WindowEvent> DisplayWindows::takeEvents() {
  std::vector<render::WindowEvent> events = first_->takeEvents();
  if (second_)
    for (const render::WindowEvent& event : second_->takeEvents())
      // The pointer belongs to the first window's pixels.
      if (std::holds_alternative<render::KeyPressed>(event) || std::holds_alternative<render::CloseRequested>(event))
        events.push_back(event);
  return events;
}

void DisplayWindows::fill(const ShowOutput& show) {
  const glm::ivec2 size = first_->framebufferSize_px();
  if (mode_ == DisplayMode::quad_buffer) {
    show({.size_px = size, .buffer = render::WindowBuffer::back_left}, 0);
    show({.size_px = size, .buffer = render::WindowBuffer::back_right}, 1);
  } else {
    show({.size_px = size}, 0);
  }
  if (!second_) return;
  drawn_.mark();
  second_->makeCurrent();
  drawn_.waitOnGpu();
  show({.size_px = second_->framebufferSize_px()}, 1);
  second_->present();
  first_->makeCurrent();
}

}  // namespace app
