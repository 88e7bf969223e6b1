// All stages between the requested and the commanded force, in the order of reference/devices 6; pure, so a replay
// reproduces every trip.
//   admit(), before contact: 1 HandGuard, 9 Staleness, 10 stop, 2 SafetyStateMachine
//   serve(), after the law:  3 SoftStart, 6 brake, 5 PassivityController, 6 VelocityGuard and BuzzDetector,
//                            7 ThermalBudget, peaks, joints, 8 slew: SafetyFilter, last, so that its limits always hold
// The brake is before the passivity controller, so that a wrong velocity cannot push; later stages only lower the
// force. Once each per tick. Frame P, about the handle. Servo thread; a few hundred flops, no clock, no allocation.
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
    HandSample hand;         ///< the sample to use
    bool relocated = false;  ///< not reached by motion
    SafetyState state = SafetyState::off;
    Fault faults = Fault::none;

    /// False while there is no force: bone that cannot be felt is not cut.
    bool mayDrill() const;
  };
  /// `limits` sanitised; `rearm` is Command::rearm.
  Admitted admit(const HandSample& hand, const SafetyLimits& limits, std::uint64_t rearm, double dt_s) noexcept;

  struct Request {
    Wrench<calibration::Patient> wrench_P;                    ///< about the handle
    calibration::Vector<calibration::Patient> vibration_P_N;  ///< active: not in the energy balance
    PassivityController::Motion motion;                       ///< of the handle since the last tick
    double max_stored_Nmm = 0.0;                              ///< what the contact could store; 0 in air
    bool touches = false;                                     ///< the tool is in tissue
  };
  /// The commanded wrench, after admit() of the same tick.
  SafetyFilter::Delivered serve(const Request& request, const SafetyLimits& limits, double dt_s) noexcept;

  double energy_Nmm() const { return passivity_.energy_Nmm(); }

 private:
  Wrench<calibration::Patient> passive(const Request& request, const SafetyLimits& limits, double soft,
                                       const glm::dvec3& brake_N, double dt_s) const noexcept;
  void observe(const Wrench<calibration::Patient>& commanded, const Wrench<calibration::Patient>& vibration,
               double through, const Request& request, const SafetyLimits& limits, double dt_s) noexcept;

  HandGuard guard_;
  Staleness staleness_;
  SafetyStateMachine readiness_;
  SoftStart soft_start_;
  VelocityGuard velocity_guard_;
  BuzzDetector buzz_;
  ThermalBudget budget_;
  PassivityController passivity_;
  SafetyFilter filter_;

  // From admit() to serve(), and to the next tick.
  Admitted admitted_;
  Staleness::Output staleness_now_;
  double confidence_ = 1.0;              ///< share of the force the guard allows
  Wrench<calibration::Patient> held_P_;  ///< the last wrench on a fresh sample
  bool touches_ = true, buzzed_off_ = false;
};

}  // namespace haptics
