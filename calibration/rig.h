// The measured rig: where the panel, the mirror, the eyes and the patient are, in frame W (mm).
// Plain data; any thread. rig_file reads and writes it; eye projection (render) uses it.
#pragma once

#include <optional>
#include <string>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"

namespace calibration {

/// Corners of the framebuffer image on the physical panel, in W, and its size in px.
struct ScreenCorners {
  glm::ivec2 px{1920, 1080};
  Point<World> lower_left, lower_right, upper_left;
};

struct Rig {
  ScreenCorners screen;
  std::optional<Plane<World>> mirror;
  Point<World> left_eye, right_eye;
  Pose<World, Patient> X_WP;
  Pose<World, Device> X_WD;

  Point<World> cyclopeanEye() const { return {0.5 * (left_eye.mm + right_eye.mm)}; }
};

/// A desktop monitor without mirror: `width_mm` wide, centre at the origin of W, eyes 500 mm in front, IPD 63 mm.
Rig desktopRig(glm::ivec2 px, double width_mm = 531.0);

}  // namespace calibration
