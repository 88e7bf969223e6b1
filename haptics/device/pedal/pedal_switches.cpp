#include "haptics/device/pedal/pedal_switches.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr double kHysteresis = 0.1;  ///< of the travel, below the threshold
constexpr double kNearAnEnd = 0.2;   ///< of the travel, around the rest position

}  // namespace

PedalSwitches::PedalSwitches(const std::vector<PedalSwitch>& switches) {
  // An axis must be up before it can be down.
  for (const PedalSwitch& one : switches) states_.push_back({one, false, one.is_axis});
}

void PedalSwitches::beginDown(std::uint16_t key) {
  for (State& state : states_)
    if (!state.is.is_axis && state.is.code == key) state.must_come_up = true;
}

void PedalSwitches::takeKey(std::uint16_t key, bool down) {
  for (State& state : states_) {
    if (state.is.is_axis || state.is.code != key) continue;
    if (!down) state.must_come_up = false;
    state.held = down && !state.must_come_up;
  }
}

void PedalSwitches::takeAxis(std::uint16_t axis, int value) {
  for (State& state : states_)
    if (state.is.is_axis && state.is.code == axis && state.is.max > state.is.min) move(state, value);
}

void PedalSwitches::move(State& axis, int value) {
  const double range = static_cast<double>(axis.is.max) - axis.is.min;
  const double from_low = std::clamp((static_cast<double>(value) - axis.is.min) / range, 0.0, 1.0);
  if (axis.is.rest == AxisRest::unknown) {
    if (from_low <= kNearAnEnd) axis.is.rest = AxisRest::low;
    if (from_low >= 1.0 - kNearAnEnd) axis.is.rest = AxisRest::high;
    if (axis.is.rest == AxisRest::unknown) return;
  }
  const double travel = axis.is.rest == AxisRest::low ? from_low : 1.0 - from_low;
  if (travel < axis.is.threshold - kHysteresis) {
    axis.held = axis.must_come_up = false;
  } else if (travel >= axis.is.threshold && !axis.must_come_up) {
    axis.held = true;
  }
}

HandActions PedalSwitches::held() const {
  HandActions held;
  for (const State& state : states_)
    if (state.held) held = held.with(state.is.action);
  return held;
}

}  // namespace haptics
