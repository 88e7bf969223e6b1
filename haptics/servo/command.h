// What the session tells the servo: tool, law, erosion and limits, as one value that flows through Latest<Command>.
// Trivially copyable. Recorded with each change, so a replay needs nothing else. Units in the names.
#pragma once

#include <cstdint>

#include "haptics/bone/erosion.h"
#include "haptics/contact/agus.h"
#include "haptics/servo/safety_limits.h"

namespace haptics {

struct Command {
  std::uint64_t serial = 0;    ///< rises by one with every change
  double bur_radius_mm = 2.0;  ///< felt, cut and drawn
  bool drill_enabled = true;   ///< false: the pedal does nothing
  AgusParameters agus;
  ErosionParameters erosion;
  SafetyLimits safety;
};

}  // namespace haptics
