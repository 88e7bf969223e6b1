// The clock of the deadlines on the USB, ns: CLOCK_MONOTONIC, or a value that a test advances. Any thread; no lock, no
// system call on Linux.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>

#include "haptics/device/monotonic_clock.h"

namespace haptics {

constexpr std::int64_t toNs(std::chrono::milliseconds time) { return std::chrono::nanoseconds(time).count(); }

struct UsbClock {
  const std::atomic<std::int64_t>* held_ns = nullptr;  ///< must outlive the clock

  std::int64_t now_ns() const noexcept { return held_ns != nullptr ? held_ns->load() : monotonic_ns(); }
  /// A sleeper reads the clock again after so much of CLOCK_MONOTONIC.
  std::int64_t maxSleep_ns() const noexcept {
    return held_ns != nullptr ? 200'000 : std::numeric_limits<std::int64_t>::max();
  }
};

}  // namespace haptics
