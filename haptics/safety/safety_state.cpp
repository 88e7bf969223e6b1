#include "haptics/safety/safety_state.h"

#include <utility>

namespace haptics {

SafetyState SafetyStateMachine::update(const Inputs& inputs, const SafetyLimits& limits, double dt_s) noexcept {
  const bool rearmed = std::exchange(last_rearm_, inputs.rearm) != inputs.rearm;
  stopped_ = stopped_ || inputs.stop_requested;
  const bool latched = state_ == SafetyState::fault && limits.must_be_armed && !rearmed;
  if (stopped_)
    state_ = SafetyState::off;
  else if (inputs.trouble || latched)
    state_ = SafetyState::fault;
  else if (!inputs.calibrated)
    state_ = SafetyState::calibrate;
  else if (inputs.docked || (inputs.resumed && limits.must_be_armed))
    state_ = SafetyState::ready;
  else
    state_ = next(inputs, limits, dt_s);
  if (state_ != SafetyState::active) let_go_s_ = 0.0;
  return state_;
}

SafetyState SafetyStateMachine::next(const Inputs& inputs, const SafetyLimits& limits, double dt_s) noexcept {
  if (state_ == SafetyState::active) {
    let_go_s_ = inputs.held ? 0.0 : let_go_s_ + dt_s;
    return let_go_s_ < limits.thresholds.release_s ? SafetyState::active : SafetyState::ready;
  }
  if (!limits.must_be_armed) return inputs.held ? SafetyState::active : SafetyState::ready;
  if (inputs.touches) return SafetyState::ready;
  if (state_ == SafetyState::armed) return inputs.held ? SafetyState::active : SafetyState::armed;
  const bool at_rest = state_ == SafetyState::ready && inputs.speed_mm_per_s < limits.thresholds.arming_mm_per_s;
  return at_rest ? SafetyState::armed : SafetyState::ready;
}

}  // namespace haptics
