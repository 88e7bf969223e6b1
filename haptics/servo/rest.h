// Why the bur does not turn although nothing is wrong, for those who have to say so to the hand.
#pragma once

#include <cstdint>

namespace haptics {

enum class Rest : std::uint8_t {
  none = 0,
  undoing = 1,  ///< bone is coming back
  caught = 2,   ///< the tool is inside bone that came back: nothing holds it until it is out
  pedal = 3,    ///< a stroke was taken back under the foot, which has to leave the pedal once
};

}  // namespace haptics
