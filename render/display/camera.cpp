#include "render/display/camera.h"

#include <cmath>

#include "calibration/geometry/units.h"
#include "render/gpu/gpu_error.h"

namespace render {

calibration::Rig cameraRig(const Camera& camera, glm::ivec2 px) {
  const glm::dvec3 back = camera.eye_P_mm - camera.look_at_P_mm;
  const double distance_mm = glm::length(back);
  const glm::dvec3 side = glm::cross(camera.up_P, back);
  const bool angle_is_good = camera.fov_y_rad > 0.0 && camera.fov_y_rad < calibration::kPi;
  if (!(distance_mm > 1e-6) || !(glm::length(side) > 1e-9 * distance_mm * glm::length(camera.up_P)) || !angle_is_good ||
      !std::isfinite(distance_mm) || px.x < 1 || px.y < 1)
    throw GpuError(
        "camera without a view, eye_mm/look_at_mm/up/fov_y_deg: eye and target must differ, up must not point along "
        "the view, the angle must lie between 0 and 180 degrees");

  // Axes of W in P.
  const glm::dvec3 z = back / distance_mm, x = glm::normalize(side), y = glm::cross(z, x);
  const glm::dquat R_PW = glm::quat_cast(glm::dmat3(x, y, z));
  const calibration::Pose<calibration::Patient, calibration::World> X_PW{R_PW, camera.look_at_P_mm};

  const double half_height_mm = distance_mm * std::tan(0.5 * camera.fov_y_rad);
  const double half_width_mm = half_height_mm * px.x / px.y;
  calibration::Rig rig;
  rig.screen = {.px = px,
                .lower_left = {{-half_width_mm, -half_height_mm, 0.0}},
                .lower_right = {{half_width_mm, -half_height_mm, 0.0}},
                .upper_left = {{-half_width_mm, half_height_mm, 0.0}}};
  rig.left_eye.mm = {-0.5 * camera.ipd_mm, 0.0, distance_mm};
  rig.right_eye.mm = {0.5 * camera.ipd_mm, 0.0, distance_mm};
  rig.X_WP = X_PW.inverse();
  return rig;
}

}  // namespace render
