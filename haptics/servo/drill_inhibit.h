// Why the bur does not turn although nothing is wrong, for those who have to say so to the hand.
#pragma once

#include <cstdint>

namespace haptics {

enum class DrillInhibit : std::uint8_t {
  none = 0,
  undo_running = 1,   ///< bone is coming back
  tool_embedded = 2,  ///< the tool is inside bone that came back: nothing holds it until it is out
  pedal_held = 3,     ///< a stroke was taken back under the foot, which has to leave the pedal_held once
};

}  // namespace haptics
