// Mouse and keys as a hand: window events move and turn the place where the tool is wanted, 1:1 on the screen.
// Drag: in the plane of the screen; wheel: 0.5 mm a notch towards or away; arrows, Q, E: 3 degrees a press; space: the
// pedal; 1..9 ask for a law. Frame W, mm. Main thread. The device (haptics::MouseDevice) makes smooth motion of it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "render/display/window.h"

namespace app {

/// The keys, for those who want to read them.
struct KeyMeaning {
  const char* key;
  const char* does;
};
inline constexpr std::array<KeyMeaning, 9> kKeys = {{
    {"Space", "pedal: drill while held"},
    {"Drag", "move in the screen's plane"},
    {"Wheel", "move nearer or farther"},
    {"Arrows", "tilt the handpiece"},
    {"Q, E", "turn the handpiece"},
    {"1 - 7", "choose the force law"},
    {"D", "lock or unlock the drill"},
    {"P", "snapshot"},
    {"Esc", "end"},
}};

class HandInput {
 public:
  /// `X_WT` is where the tool starts.
  explicit HandInput(const calibration::Pose<calibration::World, calibration::Tool>& X_WT) : X_WT_(X_WT) {}

  /// `mm_per_px`: what a pixel of the window measures on the (virtual) screen now.
  void take(const render::WindowEvent& event, double mm_per_px);

  const calibration::Pose<calibration::World, calibration::Tool>& X_WT() const { return X_WT_; }
  bool pedal() const { return pedal_; }
  bool endAsked() const { return end_asked_; }
  /// True once for every press of P.
  bool takeSnapshotAsked();
  /// Once for every press of 1 to 9: 0 to 8.
  std::optional<int> takeNumberAsked();
  /// True once for every press of D.
  bool takeDrillSwitchAsked();

 private:
  void press(const render::KeyPressed& key);
  void turn(const glm::dvec3& axis_W, double angle_rad);

  calibration::Pose<calibration::World, calibration::Tool> X_WT_;
  std::optional<int> number_asked_;
  bool pedal_ = false, end_asked_ = false, snapshot_asked_ = false, drill_switch_asked_ = false;
};

}  // namespace app
