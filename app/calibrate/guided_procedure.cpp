#include "app/calibrate/guided_procedure.h"

#include "app/text/usage_error.h"
#include "render/display/eye_projection.h"

namespace app {

GuidedProcedure::GuidedProcedure(const GuidedRun& run, glm::ivec2 screen_px, bool robot) : run_(run), robot_(robot) {
  if (run.device == nullptr && !run.practice)
    throw UsageError("calibrate: no device, give one or use --device practice:D");
  if (!run.windows && (!robot || run.device != nullptr))
    throw UsageError("calibrate: without a window only the robot can calibrate a practice stylus, add --robot");
  if (run.sounds) sounds_.emplace(run.report);
  if (run.windows) screen_.emplace(run.display, screen_px, run.report);
  if (run.device != nullptr)
    source_ = std::make_unique<DeviceSource>(*run.device);
  else if (!robot)
    source_ = std::make_unique<PracticeSource>(*run.practice);
}

void GuidedProcedure::takeEvents(const calibration::Rig& rig) {
  left_ = left_ || run_.interrupted();
  if (!screen_) return;
  const render::EyeView eye = render::eyeView(rig, render::Eye::cyclopean);
  const glm::dvec2 px = glm::max(screen_->window_px(), 1);
  for (const render::WindowEvent& event : screen_->takeEvents()) {
    const auto* key = std::get_if<render::KeyPressed>(&event);
    if (std::holds_alternative<render::CloseRequested>(event)) left_ = true;
    if (key != nullptr && key->down && key->key == render::Key::escape) left_ = true;
    if (source_) source_->take(event, eye.right_edge_W.xyz / px.x, eye.up_edge_W.xyz / px.y);
  }
}

}  // namespace app
