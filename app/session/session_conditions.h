// The conditions under which a session was recorded, which belong to every score of it (reference/product 4.6):
// program, force law with its parameters, calibration error, stereo, how the hand's force follows the model's, missed
// ticks. Plain values; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "haptics/servo/command.h"

namespace app {

struct SessionConditions {
  std::string law;                               ///< by key; "agus, hertz": it was changed
  std::map<std::string, double> law_parameters;  ///< of the last, as `--set` names them, that its force depends on
  std::optional<bool> stereo;                    ///< none: not recorded
  double force_scale = 1.0;                      ///< hand over model, below the limit
  double peak_force_N = 0.0;                     ///< at which the hand's force is clamped
  std::optional<std::uint64_t> missed_ticks;     ///< deadlines of the force loop; none: not recorded

  /// A command as it comes into force.
  void follow(const haptics::Command& command);
};

/// Kind of the event with the punctuality of the force loop, and how many deadlines it says were missed.
inline constexpr char kServoEvent[] = "servo";
std::optional<std::uint64_t> missedTicksFrom(const std::string& servo_text);

/// "law agus (stiffness 1 N/mm …), stereo off, force 1:1 up to 3.3 N, 0 ticks missed".
std::string conditionsInWords(const SessionConditions& conditions);

}  // namespace app
