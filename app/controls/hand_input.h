// Mouse and keyboard as a pose source: window events move and rotate the target pose of the tool, 1:1 on the screen.
// Drag: in the plane of the screen; wheel: 0.5 mm a notch in depth; arrows, Q, E: 3 degrees a press; space: the pedal.
// Other keys become requests (control.h) in order. haptics::MouseDevice smooths the motion. Frame W, mm. Main thread.
#pragma once

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

  /// `mm_per_px`: size of a window pixel on the (virtual) screen.
  void take(const render::WindowEvent& event, double mm_per_px);

  const calibration::Pose<calibration::World, calibration::Tool>& X_WT() const { return X_WT_; }
  bool pedal() const { return pedal_; }
  /// Since the last call.
  std::vector<ControlRequest> takeRequests();

 private:
  void press(const render::KeyPressed& key);
  void rotate(const glm::dvec3& axis_W, double angle_rad);

  calibration::Pose<calibration::World, calibration::Tool> X_WT_;
  std::vector<ControlRequest> requests_;
  bool pedal_ = false;
};

}  // namespace app
