// Whether a device that ticks has fallen silent: no tick for 50 ms since the last (reference/devices 6.9). Before its
// first tick there is nothing to miss, however long real-time priority and locked memory take: its motors are off until
// a tick commands them. ns of whichever clock the times are of. Pure; any one thread.
#pragma once

#include <cstdint>

namespace haptics {

class TickWatchdog {
 public:
  static constexpr std::int64_t kTimeout_ns = 50'000'000;

  /// `ticks` so far.
  bool hasExpired(std::uint64_t ticks, std::int64_t now_ns) {
    if (ticks != seen_) {
      seen_ = ticks;
      seen_at_ns_ = now_ns;
    }
    return seen_ > 0 && now_ns - seen_at_ns_ > kTimeout_ns;
  }

 private:
  std::uint64_t seen_ = 0;
  std::int64_t seen_at_ns_ = 0;
};

}  // namespace haptics
