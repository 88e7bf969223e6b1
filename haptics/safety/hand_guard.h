// Validates hand samples (reference/devices 6.1). A sample that is not finite, or whose handle moved or rotated faster
// than a hand can since the last valid one, is refused: the last valid pose is held at rest, pedal up, and the force
// halved; three in a row are a fault. A sample that is not fresh keeps the pose. After a pause of the ticks any finite
// pose is a new start where the device can push. Works in seconds, so it is the same at every rate. Frame P. Servo
// thread; a few dozen flops. Not smoothing.
#pragma once

#include "haptics/safety/hand_sample.h"
#include "haptics/safety/safety_limits.h"

namespace haptics {

class HandGuard {
 public:
  static constexpr int kMaxBadInARow = 3;

  struct Checked {
    HandSample hand;          ///< the sample to use
    bool refused = false;     ///< the sample was not used
    bool relocated = false;   ///< not reached by motion: first valid sample, or after a jump
    bool resumed = false;     ///< the ticks had paused
    bool lost = false;        ///< three in a row were bad
    double confidence = 1.0;  ///< share of the force allowed
  };
  Checked check(const HandSample& hand, const SafetyLimits& limits, double dt_s) noexcept;

 private:
  bool moved(const HandSample& hand, const SafetyLimits& limits) const noexcept;

  HandSample good_;
  double since_good_s_ = 0.0;
  int bad_ = 0;
  bool started_ = false;
};

}  // namespace haptics
