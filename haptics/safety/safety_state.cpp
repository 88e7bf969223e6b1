#include "haptics/safety/safety_state.h"

#include <utility>

namespace haptics {

SafetyState SafetyStateMachine::follow(const Inputs& seen, const SafetyLimits& limits, double dt_s) noexcept {
  const bool rearmed = std::exchange(last_rearm_, seen.rearm) != seen.rearm;
  stopped_ = stopped_ || seen.stop_requested;
  const bool latched = state_ == SafetyState::fault && limits.must_be_armed && !rearmed;
  if (stopped_)
    state_ = SafetyState::off;
  else if (seen.trouble || latched)
    state_ = SafetyState::fault;
  else if (!seen.calibrated)
    state_ = SafetyState::calibrate;
  else if (seen.docked || (seen.resumed && limits.must_be_armed))
    state_ = SafetyState::ready;
  else
    state_ = next(seen, limits, dt_s);
  if (state_ != SafetyState::active) let_go_s_ = 0.0;
  return state_;
}

SafetyState SafetyStateMachine::next(const Inputs& seen, const SafetyLimits& limits, double dt_s) noexcept {
  if (state_ == SafetyState::active) {
    let_go_s_ = seen.held ? 0.0 : let_go_s_ + dt_s;
    return let_go_s_ < limits.thresholds.release_s ? SafetyState::active : SafetyState::ready;
  }
  if (!limits.must_be_armed) return seen.held ? SafetyState::active : SafetyState::ready;
  if (seen.touches) return SafetyState::ready;
  if (state_ == SafetyState::armed) return seen.held ? SafetyState::active : SafetyState::armed;
  const bool at_rest = state_ == SafetyState::ready && seen.speed_mm_per_s < limits.thresholds.arming_mm_per_s;
  return at_rest ? SafetyState::armed : SafetyState::ready;
}

}  // namespace haptics
