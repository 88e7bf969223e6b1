// When the ticks of a device are due: deadlines a period apart, and what of them was missed. After a long pre-emption
// one tick happens and the next deadline of the old grid is taken. ns of whichever clock the times are of. Pure; any
// one thread; a few flops.
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

  /// How punctual the tick is that begins now. Early: the grid moves here, a period from now the next is due.
  TickTiming woke(std::int64_t now_ns) {
    TickTiming timing;
    timing.late_us = std::max(0.0, 1e-3 * static_cast<double>(now_ns - deadline_ns_));
    timing.missed = missed_;
    deadline_ns_ = std::min(deadline_ns_, now_ns);
    return timing;
  }

  /// It is over: the next deadline that still lies ahead.
  void ticked(std::int64_t now_ns) {
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
