// State of a pedal's switches: keys, and axes that count as pressed beyond a threshold, with hysteresis. A switch that
// is down at the start counts only after it has been up; an axis rests at the end near its first value, unless its
// owner named the end. Pure; the pedal's thread.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/device/pedal/hand_action.h"

namespace haptics {

enum class AxisRest : std::uint8_t { unknown, low, high };

struct PedalSwitch {
  bool is_axis = false;
  std::uint16_t code = 0;  ///< KEY_*, BTN_* or ABS_*
  HandAction action = HandAction::drill;
  double threshold = 0.5;  ///< of the travel
  AxisRest rest = AxisRest::unknown;
  int min = 0, max = 1;  ///< range of an axis
};

class PedalSwitches {
 public:
  PedalSwitches() = default;
  explicit PedalSwitches(const std::vector<PedalSwitch>& switches);

  /// Keys that are down at the beginning.
  void beginDown(std::uint16_t key);
  void takeKey(std::uint16_t key, bool down);
  void takeAxis(std::uint16_t axis, int value);

  HandActions held() const;

 private:
  struct State {
    PedalSwitch is;
    bool held = false, must_come_up = false;
  };
  void move(State& axis, int value);

  std::vector<State> states_;
};

}  // namespace haptics
