// Keeps the hand believable. A pose that is not finite, lies beyond 10 m or jumps by more than 1 m from the last good
// one is refused and the last good one held at rest, pedal up. A device that stays at the far place for 0.1 s is
// believed after all. Frame P. Servo thread; a few flops. Not smoothing.
#pragma once

#include "haptics/safety/hand_sample.h"

namespace haptics {

class HandGuard {
 public:
  struct Checked {
    HandSample hand;         ///< what to work with
    bool refused = false;    ///< it is not the sample given
    bool relocated = false;  ///< the hand did not move here: first good sample, or believed after a jump
  };
  Checked check(const HandSample& hand, double dt_s) noexcept;

 private:
  HandSample good_;
  glm::dvec3 far_mm_{0.0};
  double far_s_ = 0.0;
  bool started_ = false;
};

}  // namespace haptics
