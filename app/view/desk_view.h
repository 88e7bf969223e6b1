// The point of view on a desk without a measured rig: the patient turned about the site before unmoved eyes, and the
// strength of the loupes. With a measured rig the view is that of the eyes and this is not used. Frames W and P, mm.
// Plain values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "calibration/rig.h"

namespace app {

class DeskView {
 public:
  /// `first`: the rig of the first view, a monitor; the patient turns about `site_W`.
  DeskView(const calibration::Rig& first, const calibration::Point<calibration::World>& site_W)
      : first_(first), site_W_(site_W) {}

  /// By a drag of the mouse on the screen, px from the top left: the near side of the patient follows it.
  void turn(const glm::dvec2& by_px);
  /// Loupes stronger (steps > 0) or weaker, within kLeast… and kMostMagnified of the first view.
  void magnify(int steps);
  void backToFirst() { yaw_rad_ = pitch_rad_ = 0.0, magnified_ = 1.0; }

  /// The rig to draw with.
  calibration::Rig rig() const;
  /// From directions of the first view's W, in which the mouse's hand moves, to directions on the screen.
  glm::dquat rotation() const;
  double magnified() const { return magnified_; }
  /// Radius of the opening in the face around the line to the site, mm: 0 where the mouth leaves the site in sight,
  /// more the farther the view is turned, as cheek and lips come before it (render::Frame::face_window_mm).
  double faceWindow_mm() const;

  static constexpr double kLeastMagnified = 0.25, kMostMagnified = 4.0;

 private:
  calibration::Rig first_;
  calibration::Point<calibration::World> site_W_;
  double yaw_rad_ = 0.0, pitch_rad_ = 0.0, magnified_ = 1.0;
};

}  // namespace app
