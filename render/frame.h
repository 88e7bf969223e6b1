// One frame as plain values: what to draw, from where, onto which rig. Built by app once per frame from one scene time,
// so both eyes see the same instant. Frame W unless named. Render thread.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/rig.h"

namespace render {

enum class DisplayMode { mono, side_by_side, top_bottom, anaglyph };

struct Frame {
  calibration::Rig rig;  ///< screen, mirror, eyes, X_WP
  DisplayMode display = DisplayMode::mono;
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;  ///< the tool as drawn
  double bur_radius_mm = 2.0;
  double bur_angle_rad = 0.0;  ///< the bur turns while it drills
  bool tool_visible = true;
  double face_window_mm = 0.0;  ///< the face is cut away within this distance of the line eye-to-site; 0: never
  calibration::Point<calibration::Patient> site_P;
};

}  // namespace render
