// Timing of the servo: work per tick and lateness of its wake-up as histograms, missed deadlines. Written by the
// device's thread, read by any other while it runs; preallocated, lock-free. µs.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "haptics/loop/realtime.h"

namespace haptics {

/// A copy at one moment.
struct LoopFigures {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;    ///< deadlines skipped because a tick began or ended too late
  std::uint64_t overruns = 0;  ///< ticks whose own work took longer than a period
  double work_p50_us = 0.0, work_p99_us = 0.0, work_p999_us = 0.0,
         work_max_us = 0.0;                                        ///< percentiles to 1 µs below 4 ms
  double late_p50_us = 0.0, late_p99_us = 0.0, late_max_us = 0.0;  ///< wake-up after the deadline
  std::uint64_t watchdog_trips = 0;                                ///< motors off after 50 ms without ticks
  RealtimeGrants grants;
};

/// 1 µs bins up to 4 ms.
class MicrosecondHistogram {
 public:
  void add(double us);
  double max_us() const { return max_us_.load(std::memory_order_relaxed); }
  /// The middle of the bin of this quantile; 0 while empty.
  double percentile_us(double share) const;

 private:
  static constexpr std::size_t kBins = 4096;  ///< the last holds everything longer
  std::array<std::atomic<std::uint32_t>, kBins> bins_{};
  std::atomic<double> max_us_{0.0};
};

class LoopStatistics {
 public:
  /// Servo thread only.
  void add(double work_us, double period_us, double late_us);
  void addMissed(std::uint64_t deadlines);
  void setGrants(const RealtimeGrants& grants);

  /// Any thread.
  LoopFigures figures() const;

 private:
  MicrosecondHistogram work_, late_;
  std::atomic<std::uint64_t> ticks_{0}, missed_{0}, overruns_{0};
  std::atomic<bool> realtime_{false}, memory_locked_{false};
  std::atomic<int> core_{-1};
};

}  // namespace haptics
