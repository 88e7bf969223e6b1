// Every state of a handle, from the thread of its device to one reader, each with the time of its tick: hand_over_log.
// Frame D; s since the log began, of the clock that the
// ticks go by.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/spsc_ring.h"

namespace haptics {

struct TimedHandle {
  double t_s = 0.0;
  HandleState state;
};

class HandleLog : public SpscRing<TimedHandle> {
 public:
  /// Room for `capacity` states; 4 s at 1 kHz by default.
  explicit HandleLog(std::size_t capacity = 4'000) : SpscRing(capacity) {}
};

}  // namespace haptics
