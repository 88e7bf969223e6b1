// Every state of a handle, from the thread of its device to one reader, each with the time of its tick. Wait-free, no
// allocation after construction. When the reader is late the newest are dropped and counted. Frame D; s of the steady
// clock since the log began.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace haptics {

struct TimedHandle {
  double t_s = 0.0;
  HandleState state;
};

class HandleLog {
 public:
  /// Room for `capacity` states; 4 s at 1 kHz by default.
  explicit HandleLog(std::size_t capacity = 4'000) : ring_(capacity + 1) {}

  /// Writer only.
  void push(const TimedHandle& handle) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed), next = (head + 1) % ring_.size();
    if (next == tail_.load(std::memory_order_acquire)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ring_[head] = handle;
    head_.store(next, std::memory_order_release);
  }

  /// Reader only: appends all since the last call.
  void drainInto(std::vector<TimedHandle>& out) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t head = head_.load(std::memory_order_acquire);
    for (; tail != head; tail = (tail + 1) % ring_.size()) out.push_back(ring_[tail]);
    tail_.store(tail, std::memory_order_release);
  }

  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<TimedHandle> ring_;
  std::atomic<std::size_t> head_{0}, tail_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace haptics
