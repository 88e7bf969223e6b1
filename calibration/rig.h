// The measured rig: where the panel, the mirror, the eyes and the patient are, in frame W (mm).
// Plain data; any thread. rig_file reads and writes it; eye projection (render) uses it.
#pragma once

#include <optional>

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
  std::optional<Pose<World, Device>> second_X_WD;  ///< of the other hand's device, where it was measured

  Point<World> cyclopeanEye() const { return {0.5 * (left_eye.mm + right_eye.mm)}; }
};

/// Distance between the pupils of an average adult (rendering reference §5a), mm.
inline constexpr double kInterpupillary_mm = 63.0;

/// A monitor on the desk, without mirror: its centre is the origin of W, `width_mm` wide, as high as the pixels ask,
/// eyes `eye_distance_mm` in front of it. X_WP and X_WD are identity.
Rig desktopRig(glm::ivec2 px, double width_mm = 531.0, double eye_distance_mm = 500.0);

}  // namespace calibration
