// A way of a scripted hand from pose to pose, straight and at a speed, with the pedal up or down. Frame P is the
// device's frame D; handle and tool coincide. mm, s. Pure.
#pragma once

#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/device/simulated/led_hand.h"

namespace app {

using HandPose = calibration::Pose<calibration::Patient, calibration::Tool>;

haptics::HandTarget targetAt(const HandPose& X_PT, bool pedal);

class LedKeys {
 public:
  explicit LedKeys(const HandPose& from) : keys_{{0.0, from, false}} {}

  /// From the last pose on.
  void press(bool pedal) { keys_.back().pedal = pedal; }
  /// Turns at so much at most, by default as with a piece of tooth in the forceps.
  void moveTo(const HandPose& X_PT, double mm_per_s, double rad_per_s = 0.8);
  void hold(double seconds);
  haptics::LedPath path();

 private:
  struct Key {
    double t_s = 0.0;
    HandPose X_PT;
    bool pedal = false;  ///< down until the next key
  };
  std::vector<Key> keys_;
};

}  // namespace app
