// From the law's wrench to the commanded one: about the handle, faded over where something was switched (transition),
// then limited by the safety layer. Frame P. Servo thread; a few hundred flops, no evaluation of the bone.
#pragma once

#include "haptics/safety/safety_layer.h"
#include "haptics/servo/transition.h"

namespace haptics {

class Delivery {
 public:
  /// What is new in a tick.
  struct Changes {
    bool switched = false;   ///< law, tool or limits differ from the last tick
    bool relocated = false;  ///< the hand did not move here
  };

  /// `law`: wrench about T's origin; its motion is filled in here. `hand` as admitted this tick, `limits` sanitised.
  SafetyFilter::Delivered deliver(const SafetyLayer::Request& law, Changes changes, const HandSample& hand,
                                  SafetyLayer& safety, const SafetyLimits& limits, double dt_s) noexcept;

 private:
  PassivityController::Motion motionTo(const HandSample& hand, bool with_rotation, double dt_s) const noexcept;

  Transition transition_;
  HandSample last_hand_;
};

}  // namespace haptics
