#include "haptics/safety/safety_layer.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;

Fault when(bool condition, Fault one) { return condition ? one : Fault::none; }

/// Shortened to `peak`.
glm::dvec3 within(const glm::dvec3& v, double peak) {
  const double length = glm::length(v);
  return length > peak ? v * (peak / length) : v;
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
  confidence_ = checked.confidence;
  staleness_now_ = staleness_.update(hand.fresh, limits.thresholds, elapsed_s);

  SafetyStateMachine::Inputs inputs;
  inputs.stop_requested = hand.stop_requested;
  inputs.trouble = checked.lost || staleness_now_.overdue || buzzed_off_ || !hand.device_healthy;
  inputs.calibrated = hand.calibrated;
  inputs.docked = hand.docked;
  inputs.held = hand.held;
  inputs.resumed = checked.resumed;
  inputs.touches = touches_;
  inputs.speed_mm_per_s = glm::length(hand.handle_velocity_P_mm_per_s.xyz);
  inputs.rearm = rearm;

  admitted_.hand = hand;
  admitted_.relocated = checked.relocated;
  admitted_.state = readiness_.update(inputs, limits, dt_s);
  const bool latched = admitted_.state == SafetyState::fault && limits.must_be_armed;
  admitted_.faults = when(checked.refused, Fault::bad_pose) | when(!hand.device_healthy, Fault::device) |
                     when(staleness_now_.holds, Fault::stale) |
                     when(checked.resumed && limits.must_be_armed, Fault::resumed) |
                     when(readiness_.isReleasing(), Fault::let_go) | when(latched, Fault::latched) |
                     when(admitted_.state == SafetyState::off, Fault::stopped);
  return admitted_;
}

/// Everything that can raise a force, and the brake; then the passivity controller.
Wrench<Patient> SafetyLayer::passive(const Request& request, const SafetyLimits& limits, double soft,
                                     const glm::dvec3& brake_N, double dt_s) const noexcept {
  Wrench<Patient> wrench{{soft * (within(request.wrench_P.force_N.xyz, limits.peak_force_N) + brake_N)},
                         {soft * within(request.wrench_P.torque_Nmm.xyz, limits.peak_torque_Nmm)}};
  return passivity_.limit(wrench, request.motion, limits.slew_N_per_s, dt_s);
}

/// The energy balance gets the commanded wrench less the part of the vibration that passed; the heat budget all of it.
void SafetyLayer::observe(const Wrench<Patient>& commanded, const Wrench<Patient>& vibration, double passed,
                          const Request& request, const SafetyLimits& limits, double dt_s) noexcept {
  const bool vibrates = passed > 0.0 && std::isfinite(passed) && !staleness_now_.holds;
  passivity_.observe(vibrates ? commanded - std::min(1.0, passed) * vibration : commanded, request.motion,
                     request.max_stored_Nmm, dt_s);
  budget_.spend(glm::length(commanded.force_N.xyz), limits.continuous_force_N, dt_s);
  if (!staleness_now_.holds) held_P_ = commanded;
}

SafetyFilter::Delivered SafetyLayer::serve(const Request& request, const SafetyLimits& limits, double dt_s) noexcept {
  touches_ = request.touches;
  const HandSample& hand = admitted_.hand;
  const glm::dvec3& velocity = hand.handle_velocity_P_mm_per_s.xyz;
  const bool active = admitted_.state == SafetyState::active;
  const double soft = soft_start_.update(active, readiness_.isReleasing(), limits, dt_s);
  const VelocityGuard::Output speed = velocity_guard_.update(velocity, limits, dt_s);
  Wrench<Patient> wrench = passive(request, limits, soft, speed.brake_N, dt_s);

  // From here on the force is only lowered.
  const BuzzDetector::Output buzz = buzz_.update(velocity, limits.thresholds, dt_s);
  buzzed_off_ = buzz.off;
  const double cool = shareAtHeat(hand.motor_heat, limits.thresholds);
  const double share = active && !speed.cuts && !buzz.off ? confidence_ * buzz.share * cool : 0.0;
  const Wrench<Patient> vibration = share * Wrench<Patient>{soft * request.vibration_P_N, {}};
  wrench = share * wrench + vibration;
  if (staleness_now_.holds) wrench = (share > 0.0 ? staleness_now_.share : 0.0) * held_P_;
  const double before_N = glm::length(wrench.force_N.xyz);

  // Limits of energy, heat, device and person now.
  SafetyLimits now = limits;
  const double by_energy_N = passivity_.maxForce_N(request.motion, dt_s);
  const double by_heat_N = budget_.maxForce_N(limits.continuous_force_N);
  now.peak_force_N = std::min({limits.peak_force_N, by_energy_N, by_heat_N});
  now.peak_torque_Nmm = std::min(limits.peak_torque_Nmm, PassivityController::kLever_mm * by_energy_N);
  const bool overdrawn = passivity_.isOverdrawn(request.motion);
  const bool tripped = soft < 1.0 || share < 1.0 || staleness_now_.holds || overdrawn;
  const auto fall = tripped ? SafetyFilter::Fall::at_once : SafetyFilter::Fall::at_slew;
  SafetyFilter::Delivered delivered = filter_.serve(wrench, now, fall, dt_s, hand.jacobian_P_mm);
  observe(delivered.wrench_P, vibration, glm::length(delivered.wrench_P.force_N.xyz) / before_N, request, limits, dt_s);

  const bool beyond = !(glm::length(request.wrench_P.force_N.xyz) <= limits.peak_force_N);
  const bool hot = cool < 1.0 || (before_N > by_heat_N && by_heat_N < limits.peak_force_N);
  delivered.faults = delivered.faults | when(active && beyond, Fault::clamped) | when(active && hot, Fault::hot) |
                     when(overdrawn, Fault::overdrawn) | when(speed.cuts, Fault::too_fast) |
                     when(glm::length(speed.brake_N) > 0.0, Fault::braked) | when(buzz.share < 1.0, Fault::buzz);
  return delivered;
}

}  // namespace haptics
