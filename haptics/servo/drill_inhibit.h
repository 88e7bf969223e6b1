// Why the bur does not turn in a valid state with the pedal down; shown to the surgeon.
#pragma once

#include <cstdint>

namespace haptics {

enum class DrillInhibit : std::uint8_t {
  none = 0,
  undo_running = 1,   ///< bone is being restored
  tool_embedded = 2,  ///< the tool is inside restored bone: no force until it is out
  pedal_held = 3,     ///< a stroke was undone with the pedal down; it must be released once
};

}  // namespace haptics
