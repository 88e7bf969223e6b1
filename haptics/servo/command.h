// What the session tells the servo: tool, law, erosion and limits, as one value that flows through Latest<Command>.
// Trivially copyable. Recorded with each change, so a replay needs nothing else. Units in the names.
#pragma once

#include <cstdint>

#include "haptics/bone/erosion.h"
#include "haptics/contact/law.h"
#include "haptics/safety/safety_limits.h"
#include "haptics/tool/spindle.h"
#include "haptics/tool/tool.h"

namespace haptics {

struct Command {
  std::uint64_t serial = 0;   ///< rises by one with every change
  Tool tool;                  ///< felt, cut and drawn
  bool drill_enabled = true;  ///< false: the pedal does nothing
  bool irrigating = true;     ///< water on the bur while it turns, as a handpiece does by itself; recorded, not felt
  std::uint64_t undo_serial = 0;  ///< rises by one for every stroke to be taken back
  LawSettings law;
  ErosionSettings erosion;
  SpindleSettings spindle;
  SafetyLimits safety;
  std::uint64_t rearm = 0;  ///< another number than before: the instructor lifts a latched fault
};

}  // namespace haptics
