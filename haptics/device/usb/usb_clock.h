// What deadlines on the USB are counted on, in ns: CLOCK_MONOTONIC, or a number that somebody else moves and that
// stands still until then. Any thread; no lock, no system call on Linux.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "haptics/device/monotonic_clock.h"

namespace haptics {

struct UsbClock {
  const std::atomic<std::int64_t>* held_ns = nullptr;  ///< must outlive who has the clock

  std::int64_t now_ns() const noexcept { return held_ns != nullptr ? held_ns->load() : monotonic_ns(); }
  /// Who sleeps until a time looks at the clock again after so much of the machine's time.
  std::int64_t maxSleep_ns() const noexcept {
    return held_ns != nullptr ? 200'000 : std::numeric_limits<std::int64_t>::max();
  }
};

}  // namespace haptics
