// The tick log: the last ticks from the servo to the recorder. One of the three things that cross threads; how, and
// what happens to a late reader: hand_over_log.
#pragma once

#include "haptics/servo/tick.h"
#include "haptics/spsc_ring.h"

namespace haptics {

class TickLog : public SpscRing<Tick> {
 public:
  /// Room for `capacity` ticks; 10 s at 1 kHz by default.
  explicit TickLog(std::size_t capacity = 10'000) : SpscRing(capacity) {}
};

}  // namespace haptics
