// From what the law wants to what the hand gets: the wrench about the handle, carried over where something was switched
// (transition), with no more energy than the hand has put in (passivity), within what device and person can take
// (safety), in this order. Frame P. Servo thread; a few hundred flops, no look at the bone.
#pragma once

#include "haptics/safety/hand_sample.h"
#include "haptics/safety/passivity.h"
#include "haptics/safety/safety_filter.h"
#include "haptics/servo/transition.h"

namespace haptics {

class Delivery {
 public:
  struct Wanted {
    Wrench<calibration::Patient> wrench_P;  ///< of the law and its proxy, about T's origin
    calibration::Vector<calibration::Patient>
        tremble_P_N;               ///< the tool's vibration: active by nature, not in the books
    double most_stored_Nmm = 0.0;  ///< what the contact could hold; 0 in air
    bool switched = false;         ///< law, tool or limits are not those of the last tick
    bool relocated = false;        ///< the hand did not move here
    bool ramp_down = false;        ///< something is wrong: the force goes to zero
  };

  SafetyFilter::Served give(const Wanted& wanted, const HandSample& hand, const SafetyLimits& limits,
                            double dt_s) noexcept;

  double energy_Nmm() const { return passivity_.energy_Nmm(); }

 private:
  Passivity::Motion motionTo(const HandSample& hand, bool with_turn, double dt_s) const noexcept;

  Transition transition_;
  Passivity passivity_;
  SafetyFilter safety_;
  HandSample last_hand_;
};

}  // namespace haptics
