// Detects that a ticking device has stopped ticking: no tick for 50 ms (reference/devices 6.9). Not before its first
// tick, however long real-time priority and locked memory take: the motors are off until a tick commands them. ns of
// the clock of the times passed. Any one thread.
#pragma once

#include <cstdint>

namespace haptics {

class TickWatchdog {
 public:
  static constexpr std::int64_t kTimeout_ns = 50'000'000;

  explicit TickWatchdog(std::int64_t timeout_ns = kTimeout_ns) : timeout_ns_(timeout_ns) {}

  /// `ticks` so far.
  bool hasExpired(std::uint64_t ticks, std::int64_t now_ns) {
    if (ticks != last_ticks_) {
      last_ticks_ = ticks;
      last_tick_ns_ = now_ns;
    }
    return last_ticks_ > 0 && now_ns - last_tick_ns_ > timeout_ns_;
  }

 private:
  std::int64_t timeout_ns_;
  std::uint64_t last_ticks_ = 0;
  std::int64_t last_tick_ns_ = 0;
};

}  // namespace haptics
