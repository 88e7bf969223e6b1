#include "haptics/safety/safety_layer.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

Fault when(bool so, Fault one) { return so ? one : Fault::none; }

/// Shortened to `most`.
glm::dvec3 within(const glm::dvec3& v, double most) {
  const double length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

}  // namespace

bool SafetyLayer::Admitted::mayDrill() const {
  return state == SafetyState::active &&
         !has(faults, Fault::bad_pose | Fault::device | Fault::stale | Fault::let_go | Fault::too_fast);
}

SafetyLayer::Admitted SafetyLayer::admit(const HandSample& sample, const SafetyLimits& limits, std::uint64_t rearm,
                                         double dt_s) noexcept {
  const HandGuard::Checked checked = guard_.check(sample, limits, dt_s);
  const HandSample& hand = checked.hand;
  const double elapsed_s = std::isfinite(hand.gap_s) ? std::max(dt_s, hand.gap_s) : dt_s;
  doubt_ = checked.share;
  staleness_now_ = staleness_.follow(hand.fresh, limits.thresholds, elapsed_s);

  SafetyStateMachine::Inputs seen;
  seen.stop_requested = hand.stop_requested;
  seen.trouble = checked.lost || staleness_now_.overdue || buzzed_off_ || !hand.device_healthy;
  seen.calibrated = hand.calibrated;
  seen.docked = hand.docked;
  seen.held = hand.held;
  seen.resumed = checked.resumed;
  seen.touches = touches_;
  seen.speed_mm_per_s = glm::length(hand.handle_velocity_P_mm_per_s.xyz);
  seen.rearm = rearm;

  admitted_.hand = hand;
  admitted_.relocated = checked.relocated;
  admitted_.state = readiness_.follow(seen, limits, dt_s);
  const bool latched = admitted_.state == SafetyState::fault && limits.must_be_armed;
  admitted_.faults = when(checked.refused, Fault::bad_pose) | when(!hand.device_healthy, Fault::device) |
                     when(staleness_now_.holds, Fault::stale) |
                     when(checked.resumed && limits.must_be_armed, Fault::resumed) |
                     when(readiness_.isReleasing(), Fault::let_go) | when(latched, Fault::latched) |
                     when(admitted_.state == SafetyState::off, Fault::stopped);
  return admitted_;
}

/// All that can raise a force, and the brake, which a wrong velocity would turn into an engine; then the books.
Wrench<Patient> SafetyLayer::paidFor(const Request& wanted, const SafetyLimits& limits, double soft,
                                     const glm::dvec3& brake_N, double dt_s) const noexcept {
  Wrench<Patient> wrench{{soft * (within(wanted.wrench_P.force_N.xyz, limits.peak_force_N) + brake_N)},
                         {soft * within(wanted.wrench_P.torque_Nmm.xyz, limits.peak_torque_Nmm)}};
  return passivity_.allow(wrench, wanted.motion, limits.slew_N_per_s, dt_s);
}

/// The books get what was given, but for as much of the vibration as came through; the budget gets all of it.
void SafetyLayer::account(const Wrench<Patient>& given, const Wrench<Patient>& vibration, double through,
                          const Request& wanted, const SafetyLimits& limits, double dt_s) noexcept {
  const bool vibrates = through > 0.0 && std::isfinite(through) && !staleness_now_.holds;
  passivity_.enter(vibrates ? given - std::min(1.0, through) * vibration : given, wanted.motion, wanted.max_stored_Nmm,
                   dt_s);
  budget_.spend(glm::length(given.force_N.xyz), limits.continuous_force_N, dt_s);
  if (!staleness_now_.holds) held_P_ = given;
}

SafetyFilter::Delivered SafetyLayer::serve(const Request& wanted, const SafetyLimits& limits, double dt_s) noexcept {
  touches_ = wanted.touches;
  const HandSample& hand = admitted_.hand;
  const glm::dvec3& velocity = hand.handle_velocity_P_mm_per_s.xyz;
  const bool active = admitted_.state == SafetyState::active;
  const double soft = soft_start_.follow(active, readiness_.isReleasing(), limits, dt_s);
  const VelocityGuard::Output speed = velocity_guard_.follow(velocity, limits, dt_s);
  Wrench<Patient> wrench = paidFor(wanted, limits, soft, speed.brake_N, dt_s);

  // From here on the force only gets less.
  const BuzzDetector::Output buzz = buzz_.follow(velocity, limits.thresholds, dt_s);
  buzzed_off_ = buzz.off;
  const double cool = shareAtHeat(hand.motor_heat, limits.thresholds);
  const double share = active && !speed.cuts && !buzz.off ? doubt_ * buzz.share * cool : 0.0;
  const Wrench<Patient> vibration = share * Wrench<Patient>{soft * wanted.vibration_P_N, {}};
  wrench = share * wrench + vibration;
  if (staleness_now_.holds) wrench = (share > 0.0 ? staleness_now_.share : 0.0) * held_P_;
  const double asked_N = glm::length(wrench.force_N.xyz);

  // What books, budget, device and person can take now.
  SafetyLimits now = limits;
  const double in_books_N = passivity_.maxForce_N(wanted.motion, dt_s);
  const double lasting_N = budget_.maxForce_N(limits.continuous_force_N);
  now.peak_force_N = std::min({limits.peak_force_N, in_books_N, lasting_N});
  now.peak_torque_Nmm = std::min(limits.peak_torque_Nmm, PassivityController::kLever_mm * in_books_N);
  const bool overdrawn = passivity_.isOverdrawn(wanted.motion);
  const bool tripped = soft < 1.0 || share < 1.0 || staleness_now_.holds || overdrawn;
  const auto fall = tripped ? SafetyFilter::Fall::at_once : SafetyFilter::Fall::at_slew;
  SafetyFilter::Delivered served = filter_.serve(wrench, now, fall, dt_s, hand.jacobian_P_mm);
  account(served.wrench_P, vibration, glm::length(served.wrench_P.force_N.xyz) / asked_N, wanted, limits, dt_s);

  const bool beyond = !(glm::length(wanted.wrench_P.force_N.xyz) <= limits.peak_force_N);
  const bool hot = cool < 1.0 || (asked_N > lasting_N && lasting_N < limits.peak_force_N);
  served.faults = served.faults | when(active && beyond, Fault::clamped) | when(active && hot, Fault::hot) |
                  when(overdrawn, Fault::overdrawn) | when(speed.cuts, Fault::too_fast) |
                  when(glm::length(speed.brake_N) > 0.0, Fault::braked) | when(buzz.share < 1.0, Fault::buzz);
  return served;
}

}  // namespace haptics
