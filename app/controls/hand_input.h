// Mouse and keyboard as a pose source: window events move and rotate the target pose of the tool, 1:1 on the screen.
// Drag: in the plane of the screen; wheel: in depth, a notch is a part of the gap to the bone, so that steps are fine
// near it and no notch passes it, and grows on a longer way out, for a root canal along the tool; with Shift five times
// as much; arrows, Q, E: 3 degrees a press, Q and E about the line of sight or, for an elevator, about its shaft;
// space: the pedal. Other keys become requests (control.h) in order. haptics::MouseDevice smooths the motion. Frame W
// of the first view, mm; where the view is turned, the hand moves as it is seen. Main thread.
#pragma once

#include <optional>
#include <vector>

#include "app/controls/control.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "render/display/window.h"

namespace app {

class HandInput {
 public:
  /// `X_WT`: pose at the start.
  explicit HandInput(const calibration::Pose<calibration::World, calibration::Tool>& X_WT) : X_WT_(X_WT) {}

  /// From the tool to the bone, for the next notches; none: far.
  void setGap(std::optional<double> gap_mm) { gap_mm_ = gap_mm; }
  /// The tool is an elevator.
  void setTwisting(bool twisting) { twisting_ = twisting; }
  /// The wheel goes along the tool, not along the line of sight: into a canal.
  void setAlongTool(bool along) { along_tool_ = along; }
  /// From directions in W to directions on the screen.
  void setView(const glm::dquat& rotation) { view_ = rotation; }
  /// For a start elsewhere.
  void moveTo(const glm::dvec3& position_W_mm) { X_WT_.translation_mm = position_W_mm; }

  /// `mm_per_px`: size of a window pixel on the (virtual) screen.
  void take(const render::WindowEvent& event, double mm_per_px);

  const calibration::Pose<calibration::World, calibration::Tool>& X_WT() const { return X_WT_; }
  bool pedal() const { return pedal_; }
  /// Since the last call.
  std::vector<ControlRequest> takeRequests();

 private:
  void press(const render::KeyPressed& key);
  void rotate(const glm::dvec3& screen_axis, double angle_rad);
  void roll(double notches);
  void twist(double angle_rad);

  calibration::Pose<calibration::World, calibration::Tool> X_WT_;
  std::vector<ControlRequest> requests_;
  bool pedal_ = false, shift_ = false, twisting_ = false, along_tool_ = false;
  std::optional<double> gap_mm_;
  int leaving_ = 0;  ///< notches out without one in
  glm::dquat view_{1.0, 0.0, 0.0, 0.0};
};

}  // namespace app
