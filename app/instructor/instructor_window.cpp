#include "app/instructor/instructor_window.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <variant>

#include "app/instructor/instructor_panel.h"
#include "app/instructor/window_place.h"
#include "render/display/eye_projection.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/window_image.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr int kLeastPanoramic_px = 60;  ///< a lower one shows nothing
constexpr int kEscape = static_cast<int>(render::Key::escape);

render::Window::Options optionsFor(const render::Window& surgeons, std::optional<int> monitor,
                                   const std::optional<render::DesktopBox>& place) {
  render::Window::Options options;
  options.title = "Molar, instructor";
  options.size_px = place ? place->size_px : kUsualInstructor_px;
  if (place) options.at_px = place->at_px;
  options.monitor = monitor;
  options.wait_for_refresh = false;
  options.focused = false;
  options.share_with = &surgeons;
  return options;
}

/// Its middle can be seen.
bool isOnAMonitor(const render::DesktopBox& place) {
  const glm::ivec2 middle = place.at_px + place.size_px / 2;
  return std::ranges::any_of(render::monitors(), [&](const render::Monitor& one) {
    return glm::all(glm::greaterThanEqual(middle, one.at_px)) && glm::all(glm::lessThan(middle, one.at_px + one.px));
  });
}

}  // namespace

/// The window with its panel, while it is open.
struct InstructorWindow::Open {
  Open(const render::Window& surgeons, std::optional<int> monitor, const std::optional<render::DesktopBox>& place)
      : window(optionsFor(surgeons, monitor, place)) {
    // Until the rehearsal begins it would show whatever its memory holds.
    render::clearWindow();
    window.present();
    ImGui::GetIO().KeyMap[ImGuiKey_Escape] = kEscape;
    if (!ImGui_ImplOpenGL3_Init("#version 450"))
      throw render::GpuError("instructor's window: OpenGL cannot draw its panel, continue without --instructor");
  }
  ~Open() {
    rememberPlace(instructorWindowFile(), window.desktopBox());
    window.makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
  }

  void feed(const render::WindowEvent& event);
  void feedPending();

  render::Window window;
  PanelContext context;
  std::deque<render::WindowEvent> pending;
  std::vector<render::WindowEvent> keys;
  render::WindowUpload panoramic;
  bool close_requested = false;
  Clock::time_point drawn{};
};

void InstructorWindow::Open::feed(const render::WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  if (const auto* moved = std::get_if<render::PointerMoved>(&event))
    io.MousePos = {static_cast<float>(moved->to_px.x), static_cast<float>(moved->to_px.y)};
  else if (const auto* button = std::get_if<render::ButtonPressed>(&event))
    io.MouseDown[button->button == render::MouseButton::right ? 1 : 0] = button->down;
  else if (const auto* wheel = std::get_if<render::WheelTurned>(&event))
    io.MouseWheel += static_cast<float>(wheel->notches);
  else if (std::holds_alternative<render::CloseRequested>(event))
    close_requested = true;
  else if (const auto* key = std::get_if<render::KeyPressed>(&event); key && key->key == render::Key::escape)
    io.KeysDown[kEscape] = io.KeysDown[kEscape] || key->down;  // closes an open list in the next drawing
  else
    keys.push_back(event);
}

/// A click shorter than the interval still counts: its release waits for the next drawing.
void InstructorWindow::Open::feedPending() {
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

InstructorWindow::InstructorWindow(SurgeonDisplay& display, const calibration::Rig& rig, int after_monitor,
                                   ReportLine report)
    : display_(display), rig_(rig), after_monitor_(after_monitor), report_(std::move(report)) {
  open();
  // It shares with the surgeon's windows and must be closed before them.
  display_.beforeRecreation([this] { open_.reset(); });
}

InstructorWindow::~InstructorWindow() = default;

void InstructorWindow::open() {
  if (display_.window() == nullptr) return;
  const int next = after_monitor_ + (display_.mode() == render::DisplayMode::two_windows ? 2 : 1);
  const bool exists = next < static_cast<int>(render::monitors().size());
  const std::optional<int> monitor = exists ? std::optional(next) : std::nullopt;
  // Where it was left, unless that is over the picture; else on the next monitor, or beside the picture.
  const render::DesktopBox picture = display_.window()->desktopBox();
  std::optional<render::DesktopBox> place = rememberedPlace(instructorWindowFile());
  if (place && (!areApart(*place, picture) || !isOnAMonitor(*place))) place.reset();
  if (!place && !monitor) place = placeBeside(picture, display_.window()->panelBox());
  if (!place && !monitor)
    report_("instructor's window: there is no room beside the picture, use a second monitor or a smaller --size");
  try {
    open_ = std::make_unique<Open>(*display_.window(), monitor, place);
  } catch (const render::GpuError& error) {
    report_(error.what());
  }
  display_.makeCurrent();
}

void InstructorWindow::reopenAfterReset() {
  if (std::exchange(context_losses_, display_.contextLosses()) != display_.contextLosses()) open();
}

bool InstructorWindow::isDue() const { return open_ && Clock::now() - open_->drawn >= kInterval; }

void InstructorWindow::showPanoramic(glm::ivec2 window_px, const glm::dvec3& bur_P_mm) {
  if (!panoramic_) return;
  const ImageArea area = panoramicArea(window_px, rig_.screen.px, panoramic_->size_px(1.0));
  const double zoom = static_cast<double>(area.size_px.x) / panoramic_->size_px(1.0).x;
  if (area.size_px.y < kLeastPanoramic_px) return;
  open_->panoramic.show(
      panoramic_->image(zoom, bur_P_mm),
      {.size_px = area.size_px, .corner_px = {area.corner_px.x, window_px.y - area.corner_px.y - area.size_px.y}});
}

InstructorWindow::Input InstructorWindow::draw(const RehearsalStatus& status) {
  Open& self = *open_;
  self.feedPending();
  const Clock::time_point now = Clock::now();
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = std::max(1e-3f, std::chrono::duration<float>(now - self.drawn).count());
  self.drawn = now;
  Input input{{}, std::exchange(self.keys, {})};
  const glm::ivec2 px = self.window.framebufferSize_px();
  if (px.x > 0 && px.y > 0) {
    io.DisplaySize = {static_cast<float>(px.x), static_cast<float>(px.y)};
    render::FrameRenderer& renderer = display_.renderer();
    renderer.composeForBystander();
    render::FrameFence composed;
    composed.mark();
    self.window.makeCurrent();
    composed.waitOnGpu();
    render::clearWindow();
    const ImageArea area = imageArea(px, rig_.screen.px);
    // Through a mirror the surgeon's image is flipped; the instructor's is not.
    const render::EyeView view = render::eyeView(rig_, render::Eye::cyclopean);
    const glm::dvec3 to_the_right = rig_.right_eye.mm - rig_.left_eye.mm;
    renderer.showBystander({.size_px = area.size_px,
                            .corner_px = {area.corner_px.x, px.y - area.corner_px.y - area.size_px.y},
                            .flipped_x = glm::dot(view.right_edge_W.xyz, to_the_right) < 0.0,
                            .flipped_y = view.up_edge_W.xyz.y < 0.0});
    showPanoramic(px, status.tick.proxy_P.mm);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    input.requests = drawInstructorPanel(status, px, rig_.screen.px);
    ImGui::Render();
    io.KeysDown[kEscape] = false;
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    self.window.present();
  }
  if (self.close_requested) open_.reset();
  display_.makeCurrent();
  return input;
}

}  // namespace app
