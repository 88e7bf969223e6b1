// Timing of ticks that a scheduler calls: the interval since the last call against the period. The deadlines of the
// scheduler's own grid are not known, so a late call counts once and an early one does not compensate it. µs, ns of
// monotonic_ns(); the scheduler's thread; a few flops.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "haptics/device/haptic_device.h"

namespace haptics {

class CallbackTiming {
 public:
  explicit CallbackTiming(double rate_Hz) : period_us_(1e6 / rate_Hz) {}

  TickTiming next(std::int64_t now_ns) {
    TickTiming timing;
    if (last_ns_) {
      const double interval_us = 1e-3 * static_cast<double>(now_ns - *last_ns_);
      timing.late_us = std::max(0.0, interval_us - period_us_);
      timing.missed = static_cast<std::uint64_t>(std::max(0.0, std::round(interval_us / period_us_) - 1.0));
    }
    last_ns_ = now_ns;
    return timing;
  }

 private:
  double period_us_;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace haptics
