#include "app/instructor/instructor_display.h"

#include <utility>
#include <variant>

#include "render/display/eye_projection.h"
#include "render/gpu/gpu_error.h"

namespace app {

InstructorDisplay::InstructorDisplay(SurgeonDisplay& display, const calibration::Rig& rig, int after_monitor,
                                     std::function<void(const std::string&)> report)
    : display_(display), rig_(rig), after_monitor_(after_monitor), report_(std::move(report)) {
  open();
  // It shares with the surgeon's windows, so it goes before them.
  display_.beforeRecreation([this] { window_.reset(); });
}

void InstructorDisplay::open() {
  if (display_.window() == nullptr) return;
  const int next = after_monitor_ + (display_.mode() == render::DisplayMode::two_windows ? 2 : 1);
  try {
    const bool is_there = next < static_cast<int>(render::monitors().size());
    window_.emplace(*display_.window(), is_there ? std::optional(next) : std::nullopt);
  } catch (const render::GpuError& error) {
    report_(error.what());
  }
  display_.makeCurrent();
}

void InstructorDisplay::reopenAfterReset() {
  if (std::exchange(context_losses_, display_.contextLosses()) != display_.contextLosses()) open();
}

InstructorDisplay::Input InstructorDisplay::serve(const RehearsalStatus& status) {
  const render::EyeView view = render::eyeView(rig_, render::Eye::cyclopean);
  const glm::dvec3 to_the_right = rig_.right_eye.mm - rig_.left_eye.mm;
  const InstructorWindow::SurgeonImage seen{rig_.screen.px, glm::dot(view.right_edge_W.xyz, to_the_right) < 0.0,
                                            view.up_edge_W.xyz.y < 0.0};
  display_.renderer().composeForBystander();
  render::FrameFence composed;
  composed.mark();
  Input input;
  input.requests = window_->draw(status, display_.renderer(), composed, seen);
  display_.makeCurrent();
  for (const render::WindowEvent& event : window_->takeKeys()) {
    if (!std::holds_alternative<render::CloseRequested>(event)) {
      input.keys.push_back(event);
      continue;
    }
    window_.reset();
    display_.makeCurrent();
    break;
  }
  return input;
}

}  // namespace app
