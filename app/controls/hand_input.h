// Mouse and keys as a hand: window events move and turn the place where the tool is wanted, 1:1 on the screen.
// Drag: in the plane of the screen; wheel: 0.5 mm a notch towards or away; arrows, Q, E: 3 degrees a press; space: the
// pedal. All other keys are requests (control.h), in the order they were pressed. Frame W, mm. Main thread. The device
// (haptics::MouseDevice) makes smooth motion of it.
#pragma once

#include <vector>

#include "app/controls/control.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "render/display/window.h"

namespace app {

class HandInput {
 public:
  /// `X_WT` is where the tool starts.
  explicit HandInput(const calibration::Pose<calibration::World, calibration::Tool>& X_WT) : X_WT_(X_WT) {}

  /// `mm_per_px`: what a pixel of the window measures on the (virtual) screen now.
  void take(const render::WindowEvent& event, double mm_per_px);

  const calibration::Pose<calibration::World, calibration::Tool>& X_WT() const { return X_WT_; }
  bool pedal() const { return pedal_; }
  /// Everything asked for since the last call.
  std::vector<ControlRequest> takeRequests();

 private:
  void press(const render::KeyPressed& key);
  void turn(const glm::dvec3& axis_W, double angle_rad);

  calibration::Pose<calibration::World, calibration::Tool> X_WT_;
  std::vector<ControlRequest> requests_;
  bool pedal_ = false;
};

}  // namespace app
