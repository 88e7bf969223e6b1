// Keeps the hand believable (reference/devices 6.1). A sample that is not finite, or whose handle moved or turned
// faster than a hand can since the last good one, is refused: the last good pose is held at rest, pedal up, and the
// force halved; three in a row are a fault. A sample that is not fresh keeps the pose and says nothing new. After a
// pause of the ticks any finite pose is a new beginning where somebody can be pushed. Goes by seconds, so it is the
// same at every rate. Frame P. Servo thread; a few dozen flops. Not smoothing.
#pragma once

#include "haptics/safety/hand_sample.h"
#include "haptics/safety/safety_limits.h"

namespace haptics {

class HandGuard {
 public:
  static constexpr int kBadInARow = 3;

  struct Checked {
    HandSample hand;         ///< what to work with
    bool refused = false;    ///< it is not the sample given
    bool relocated = false;  ///< the hand did not move here: first good sample, or believed after a jump
    bool resumed = false;    ///< the ticks had paused
    bool lost = false;       ///< three in a row were bad
    double share = 1.0;      ///< of the force that may be given while in doubt
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
