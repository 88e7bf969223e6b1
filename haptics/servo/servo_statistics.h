// How well the servo keeps time: work per tick as a histogram, missed deadlines, the worst lateness. Written by the
// servo thread, read by any other while it runs; preallocated, lock-free. µs.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics {

/// A copy of the figures at one moment.
struct ServoFigures {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  ///< deadlines passed over because a tick began or ended too late
  double work_p50_us = 0.0, work_p99_us = 0.0, work_max_us = 0.0;  ///< percentiles to 1 µs below 4 ms
  double latest_us = 0.0;                                          ///< longest time a tick woke after its deadline
  bool realtime = false;                                           ///< the scheduler granted SCHED_FIFO
  bool memory_locked = false;                                      ///< mlockall succeeded
};

class ServoStatistics {
 public:
  /// Servo thread only.
  void add(double work_us, double late_us);
  void addMissed(std::uint64_t deadlines);
  void setGrants(bool realtime, bool memory_locked);

  /// Any thread.
  ServoFigures figures() const;

 private:
  static constexpr std::size_t kBins = 4096;  ///< of 1 µs; the last holds everything longer
  std::array<std::atomic<std::uint32_t>, kBins> work_{};
  std::atomic<std::uint64_t> ticks_{0}, missed_{0};
  std::atomic<double> work_max_us_{0.0}, latest_us_{0.0};
  std::atomic<bool> realtime_{false}, memory_locked_{false};
};

}  // namespace haptics
