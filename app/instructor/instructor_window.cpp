#include "app/instructor/instructor_window.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "render/gpu/gpu_error.h"
#include "render/gpu/window_image.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kBetweenDrawings = std::chrono::milliseconds(100);

render::Window::Options optionsFor(const render::Window& surgeons, std::optional<int> monitor) {
  render::Window::Options options;
  options.title = "Molar, instructor";
  options.size_px = {1360, 900};
  options.monitor = monitor;
  options.wait_for_refresh = false;
  options.focused = false;
  options.share_with = &surgeons;
  return options;
}

}  // namespace

struct InstructorWindow::Impl {
  Impl(const render::Window& surgeons, std::optional<int> monitor) : window(optionsFor(surgeons, monitor)) {
    if (!ImGui_ImplOpenGL3_Init("#version 450"))
      throw render::GpuError("instructor's window: OpenGL can not draw its panel, continue without --instructor");
  }
  ~Impl() {
    window.makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
  }

  void feed(const render::WindowEvent& event);
  void feedPending();

  render::Window window;
  PanelContext context;  // goes as well where OpenGL refuses the panel
  std::deque<render::WindowEvent> pending;
  std::vector<render::WindowEvent> keys;
  Clock::time_point drawn{};
};

void InstructorWindow::Impl::feed(const render::WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  if (const auto* moved = std::get_if<render::PointerMoved>(&event))
    io.MousePos = {static_cast<float>(moved->to_px.x), static_cast<float>(moved->to_px.y)};
  else if (const auto* button = std::get_if<render::ButtonPressed>(&event))
    io.MouseDown[button->button == render::MouseButton::right ? 1 : 0] = button->down;
  else if (const auto* wheel = std::get_if<render::WheelTurned>(&event))
    io.MouseWheel += static_cast<float>(wheel->notches);
  else
    keys.push_back(event);
}

/// A click shorter than the time between drawings is still a click: its release waits for the next one.
void InstructorWindow::Impl::feedPending() {
  for (const render::WindowEvent& event : window.takeEvents()) pending.push_back(event);
  bool pressed = false;
  while (!pending.empty()) {
    const auto* button = std::get_if<render::ButtonPressed>(&pending.front());
    if (button != nullptr && !button->down && pressed) return;
    pressed = pressed || (button != nullptr && button->down);
    feed(pending.front());
    pending.pop_front();
  }
}

InstructorWindow::InstructorWindow(const render::Window& surgeons, std::optional<int> monitor)
    : impl_(std::make_unique<Impl>(surgeons, monitor)) {}

InstructorWindow::~InstructorWindow() = default;

bool InstructorWindow::isDue() const { return Clock::now() - impl_->drawn >= kBetweenDrawings; }

std::vector<ControlRequest> InstructorWindow::draw(const RehearsalStatus& status, render::FrameRenderer& renderer,
                                                   const render::FrameFence& composed, const SurgeonImage& seen) {
  Impl& self = *impl_;
  self.feedPending();
  const Clock::time_point now = Clock::now();
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = std::max(1e-3f, std::chrono::duration<float>(now - self.drawn).count());
  self.drawn = now;
  const glm::ivec2 px = self.window.framebufferSize_px();
  if (px.x <= 0 || px.y <= 0) return {};
  io.DisplaySize = {static_cast<float>(px.x), static_cast<float>(px.y)};

  self.window.makeCurrent();
  composed.waitOnGpu();
  render::clearWindow();
  const ImageArea place = imageArea(px, seen.px);
  renderer.showBystander({.size_px = place.size_px,
                          .corner_px = {place.corner_px.x, px.y - place.corner_px.y - place.size_px.y},
                          .flipped_x = seen.flipped_x,
                          .flipped_y = seen.flipped_y});
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  std::vector<ControlRequest> requests = drawInstructorPanel(status, px, seen.px);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  self.window.present();
  return requests;
}

std::vector<render::WindowEvent> InstructorWindow::takeKeys() { return std::exchange(impl_->keys, {}); }

}  // namespace app
