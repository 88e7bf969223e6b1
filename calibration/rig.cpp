#include "calibration/rig.h"

namespace calibration {

Rig desktopRig(glm::ivec2 px, double width_mm, double eye_distance_mm) {
  const double x = 0.5 * width_mm, y = x * px.y / px.x;
  Rig rig;
  rig.screen = {px, {{-x, -y, 0.0}}, {{x, -y, 0.0}}, {{-x, y, 0.0}}};
  rig.left_eye = {{-0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  rig.right_eye = {{0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  return rig;
}

}  // namespace calibration
