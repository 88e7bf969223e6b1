// A plain camera in front of the patient, expressed as a rig: an unmirrored screen through the point looked at, facing
// the eye, and W on it (x right, y up, z to the viewer). So images from a camera and from the workstation share one
// path. Frame P, mm. Any thread; pure.
#pragma once

#include "calibration/rig.h"

namespace render {

struct Camera {
  glm::dvec3 eye_P_mm{0.0, -300.0, 0.0};
  glm::dvec3 look_at_P_mm{0.0};
  glm::dvec3 up_P{0.0, 0.0, 1.0};
  double fov_y_rad = 0.5235987755982988;  ///< 30 degrees
  double ipd_mm = 63.0;                   ///< left and right eye lie half of it beside the camera
};

/// Throws GpuError when eye and target coincide, `up` points along the view, or the angle is not within (0, pi).
calibration::Rig cameraRig(const Camera& camera, glm::ivec2 px);

}  // namespace render
