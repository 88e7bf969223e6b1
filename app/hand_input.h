// Mouse and keys as a hand: window events move and turn the place where the tool is wanted, 1:1 on the screen.
// Drag: in the plane of the screen; wheel: 0.5 mm a notch towards or away; arrows, Q, E: 3 degrees a press; space: the
// pedal. All other keys are wishes, in the order they were pressed. Frame W, mm. Main thread. The device
// (haptics::MouseDevice) makes smooth motion of it.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "render/display/window.h"

namespace app {

/// The keys, for those who want to read them.
struct KeyMeaning {
  const char* key;
  const char* does;
};
inline constexpr std::array<KeyMeaning, 15> kKeys = {{
    {"Space", "pedal: drill while held"},
    {"Drag", "move in the screen's plane"},
    {"Wheel", "move nearer or farther"},
    {"Arrows", "tilt the handpiece"},
    {"Q, E", "turn the handpiece"},
    {"1 - 7", "choose the force law"},
    {"D", "lock or unlock the drill"},
    {"T", "change the tool"},
    {"I", "irrigation on or off"},
    {"U", "undo the last stroke"},
    {"P", "snapshot"},
    {"X", "emergency stop: motors off"},
    {"R", "arm again after a fault"},
    {"H", "the handle stands at home"},
    {"Esc", "end"},
}};

/// What a key asks for, once a press.
enum class Wish {
  drill_switch,
  tool_change,
  irrigation_switch,
  undo,
  snapshot,
  emergency_stop,
  arm_again,
  set_home,
  end
};
struct LawWish {
  int number = 0;  ///< from 0
};
using KeyWish = std::variant<Wish, LawWish>;

class HandInput {
 public:
  /// `X_WT` is where the tool starts.
  explicit HandInput(const calibration::Pose<calibration::World, calibration::Tool>& X_WT) : X_WT_(X_WT) {}

  /// `mm_per_px`: what a pixel of the window measures on the (virtual) screen now.
  void take(const render::WindowEvent& event, double mm_per_px);

  const calibration::Pose<calibration::World, calibration::Tool>& X_WT() const { return X_WT_; }
  bool pedal() const { return pedal_; }
  /// Everything asked for since the last call.
  std::vector<KeyWish> takeWishes();

 private:
  void press(const render::KeyPressed& key);
  void turn(const glm::dvec3& axis_W, double angle_rad);

  calibration::Pose<calibration::World, calibration::Tool> X_WT_;
  std::vector<KeyWish> wishes_;
  bool pedal_ = false;
};

}  // namespace app
