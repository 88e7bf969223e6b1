// A plain camera expressed as a rig: an unmirrored screen through the target point, facing the eye, with W on it (x
// right, y up, z to the viewer). So camera and workstation share one rendering path. Frame P, mm. Any thread; pure.
#pragma once

#include "calibration/rig.h"

namespace render {

struct Camera {
  glm::dvec3 eye_P_mm{0.0, -300.0, 0.0};
  glm::dvec3 look_at_P_mm{0.0};
  glm::dvec3 up_P{0.0, 0.0, 1.0};
  double fov_y_rad = 0.5235987755982988;  ///< 30 degrees
  double ipd_mm = 63.0;  ///< interpupillary distance; the eyes are half of it left and right of the camera
};

/// Throws GpuError when eye and target coincide, `up` points along the view, or the angle is not within (0, pi).
calibration::Rig cameraRig(const Camera& camera, glm::ivec2 px);

}  // namespace render
