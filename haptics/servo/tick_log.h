// The tick log: a ring of the last ticks from the servo to the recorder. One of the three things that cross threads.
// One writer, one reader, wait-free, no allocation after construction. When the reader is late the newest ticks are
// dropped and counted, never the servo held up.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/servo/tick.h"

namespace haptics {

class TickLog {
 public:
  /// Room for `capacity` ticks; 10 s at 1 kHz by default.
  explicit TickLog(std::size_t capacity = 10'000) : ring_(capacity + 1) {}

  /// Writer only.
  void push(const Tick& tick) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t next = (head + 1) % ring_.size();
    if (next == tail_.load(std::memory_order_acquire)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ring_[head] = tick;
    head_.store(next, std::memory_order_release);
  }

  /// Reader only: appends everything logged so far to `out`.
  void drainInto(std::vector<Tick>& out) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t head = head_.load(std::memory_order_acquire);
    for (; tail != head; tail = (tail + 1) % ring_.size()) out.push_back(ring_[tail]);
    tail_.store(tail, std::memory_order_release);
  }

  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<Tick> ring_;
  std::atomic<std::size_t> head_{0}, tail_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace haptics
