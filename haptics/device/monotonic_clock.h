// Now, in nanoseconds of CLOCK_MONOTONIC: the clock that paced devices and USB deadlines are counted on. Any thread, no
// system call on Linux.
#pragma once

#include <chrono>
#include <cstdint>

namespace haptics {

inline std::int64_t monotonic_ns() {
  using std::chrono::duration_cast, std::chrono::nanoseconds;
  return duration_cast<nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace haptics
