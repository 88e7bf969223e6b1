#include "calibration/rig.h"

#include "calibration/arm/phantom_models.h"

namespace calibration {

Rig desktopRig(glm::ivec2 px, double width_mm, double eye_distance_mm) {
  const double x = 0.5 * width_mm, y = x * px.y / px.x;
  Rig rig;
  rig.screen = {px, {{-x, -y, 0.0}}, {{x, -y, 0.0}}, {{-x, y, 0.0}}};
  rig.left_eye = {{-0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  rig.right_eye = {{0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  return rig;
}

std::optional<MeasuredArm> measuredArm(const Rig& rig) {
  if (!rig.device || !rig.arm) return std::nullopt;
  const PhantomModel* const model = findPhantomModel(rig.device->model);
  if (model == nullptr) return std::nullopt;
  return MeasuredArm{model->geometry, *rig.arm, rig.X_WD};
}

}  // namespace calibration
