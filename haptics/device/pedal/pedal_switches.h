// The switches of a pedal and what they hold: keys, and axes that count as pressed beyond a part of their travel, with
// hysteresis. What is down when the pedal is found counts only after it has been up; an axis rests at the end near
// which it is first heard of, unless its owner said which. Pure; the pedal's thread.
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
  int least = 0, most = 1;  ///< an axis's range
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
