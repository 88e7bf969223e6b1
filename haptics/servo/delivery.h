// From what the law wants to what the hand gets: the wrench about the handle, carried over where something was switched
// (transition), then what the safety layer leaves of it. Frame P. Servo thread; a few hundred flops, no look at the
// bone.
#pragma once

#include "haptics/safety/safety_layer.h"
#include "haptics/servo/transition.h"

namespace haptics {

class Delivery {
 public:
  struct Request {
    Wrench<calibration::Patient> wrench_P;  ///< of the law and its proxy, about T's origin
    calibration::Vector<calibration::Patient>
        vibration_P_N;            ///< the tool's vibration: active by nature, not in the books
    double max_stored_Nmm = 0.0;  ///< what the contact could hold; 0 in air
    bool switched = false;        ///< law, tool or limits are not those of the last tick
    bool relocated = false;       ///< the hand did not move here
    bool touches = false;         ///< the tool is in tissue
  };

  /// `hand` as the layer admitted it this tick, `limits` sanitised.
  SafetyFilter::Delivered deliver(const Request& wanted, const HandSample& hand, SafetyLayer& safety,
                                  const SafetyLimits& limits, double dt_s) noexcept;

 private:
  PassivityController::Motion motionTo(const HandSample& hand, bool with_turn, double dt_s) const noexcept;

  Transition transition_;
  HandSample last_hand_;
};

}  // namespace haptics
