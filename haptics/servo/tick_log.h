// The tick log: every tick from the servo to the recorder, through a ring (spsc_ring).
#pragma once

#include "haptics/servo/tick.h"
#include "haptics/spsc_ring.h"

namespace haptics {

class TickLog : public SpscRing<Tick> {
 public:
  /// 10 s at 1 kHz by default.
  explicit TickLog(std::size_t capacity = 10'000) : SpscRing(capacity) {}
};

}  // namespace haptics
