// The deadlines of a paced device, one period apart, and how many of them were missed. After a long pre-emption one
// tick happens, and the next deadline of the old grid is taken. ns of the caller's clock. One thread; a few flops.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "haptics/device/haptic_device.h"

namespace haptics {

class DeadlineGrid {
 public:
  DeadlineGrid(double rate_Hz, std::int64_t now_ns)
      : period_ns_(static_cast<std::int64_t>(std::llround(1e9 / rate_Hz))), deadline_ns_(now_ns + period_ns_) {}

  std::int64_t next_ns() const { return deadline_ns_; }

  /// Timing of the tick that begins now. Early: the grid moves, the next tick is due a period from now.
  TickTiming beginTick(std::int64_t now_ns) {
    TickTiming timing;
    timing.late_us = std::max(0.0, 1e-3 * static_cast<double>(now_ns - deadline_ns_));
    timing.missed = missed_;
    deadline_ns_ = std::min(deadline_ns_, now_ns);
    return timing;
  }

  /// The tick is over: takes the next deadline that still lies ahead.
  void endTick(std::int64_t now_ns) {
    deadline_ns_ += period_ns_;
    const std::int64_t behind_ns = now_ns - deadline_ns_;
    missed_ = behind_ns > 0 ? static_cast<std::uint64_t>(behind_ns / period_ns_ + 1) : 0;
    deadline_ns_ += static_cast<std::int64_t>(missed_) * period_ns_;
  }

 private:
  std::int64_t period_ns_, deadline_ns_;
  std::uint64_t missed_ = 0;
};

}  // namespace haptics
