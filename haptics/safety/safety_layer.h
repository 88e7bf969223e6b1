// Everything between a wish and the motors, in the order of reference/devices 6; pure, so a replay trips alike.
//   admit(), before anybody touches bone: 1 HandGuard, 9 Staleness, 10 stop, 2 SafetyStateMachine
//   serve(), after the law: 3 SoftStart, 6 brake, 5 PassivityController, 6 VelocityGuard and BuzzDetector, 7
//   ThermalBudget and peaks, joints, 8 slew: SafetyFilter, which is last, so that its limits hold whatever the others
//   do
// The brake stands before the books of energy, so that a wrong velocity can not push; what comes after the books only
// ever lowers. Once each a tick. Frame P, about the handle. Servo thread; a few hundred flops, no clock, no allocation.
// Not the contact's stability (contact/law_limits), not the motor gate, which no state can talk to.
#pragma once

#include "haptics/safety/buzz_detector.h"
#include "haptics/safety/hand_guard.h"
#include "haptics/safety/passivity_controller.h"
#include "haptics/safety/safety_filter.h"
#include "haptics/safety/safety_state.h"
#include "haptics/safety/soft_start.h"
#include "haptics/safety/staleness.h"
#include "haptics/safety/thermal_budget.h"
#include "haptics/safety/velocity_guard.h"

namespace haptics {

class SafetyLayer {
 public:
  struct Admitted {
    HandSample hand;         ///< what to work with
    bool relocated = false;  ///< the hand did not move here
    SafetyState state = SafetyState::off;
    Fault faults = Fault::none;

    /// Nothing is cut that can not be felt.
    bool mayDrill() const;
  };
  /// `limits` sanitised; `rearm` is Command::rearm.
  Admitted admit(const HandSample& hand, const SafetyLimits& limits, std::uint64_t rearm, double dt_s) noexcept;

  struct Request {
    Wrench<calibration::Patient> wrench_P;                    ///< about the handle
    calibration::Vector<calibration::Patient> vibration_P_N;  ///< active by nature: not in the books
    PassivityController::Motion motion;                       ///< of the handle since the last tick
    double max_stored_Nmm = 0.0;                              ///< what the contact could hold; 0 in air
    bool touches = false;                                     ///< the tool is in tissue
  };
  /// What the hand gets of it, after admit() of the same tick.
  SafetyFilter::Delivered serve(const Request& wanted, const SafetyLimits& limits, double dt_s) noexcept;

  double energy_Nmm() const { return passivity_.energy_Nmm(); }

 private:
  Wrench<calibration::Patient> paidFor(const Request& wanted, const SafetyLimits& limits, double soft,
                                       const glm::dvec3& brake_N, double dt_s) const noexcept;
  void account(const Wrench<calibration::Patient>& given, const Wrench<calibration::Patient>& vibration, double through,
               const Request& wanted, const SafetyLimits& limits, double dt_s) noexcept;

  HandGuard guard_;
  Staleness staleness_;
  SafetyStateMachine readiness_;
  SoftStart soft_start_;
  VelocityGuard velocity_guard_;
  BuzzDetector buzz_;
  ThermalBudget budget_;
  PassivityController passivity_;
  SafetyFilter filter_;

  // From one call to the next.
  Admitted admitted_;
  Staleness::Output staleness_now_;
  double doubt_ = 1.0;                   ///< share of the force the guard leaves
  Wrench<calibration::Patient> held_P_;  ///< while nothing new is measured
  bool touches_ = true, buzzed_off_ = false;
};

}  // namespace haptics
