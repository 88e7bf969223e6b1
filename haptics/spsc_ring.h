// Single-producer, single-consumer ring: every value from one writer to one reader. Wait-free, no allocation after
// construction. When it is full the newest values are dropped and counted; the writer never waits. For the newest value
// alone: Latest.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace haptics {

template <class Entry>
class SpscRing {
 public:
  explicit SpscRing(std::size_t capacity) : ring_(capacity + 1) {}

  /// Writer only.
  void push(const Entry& entry) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed), next = (head + 1) % ring_.size();
    if (next == tail_.load(std::memory_order_acquire)) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ring_[head] = entry;
    head_.store(next, std::memory_order_release);
  }

  /// Reader only: appends everything so far to `out`.
  void drainInto(std::vector<Entry>& out) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t head = head_.load(std::memory_order_acquire);
    for (; tail != head; tail = (tail + 1) % ring_.size()) out.push_back(ring_[tail]);
    tail_.store(tail, std::memory_order_release);
  }

  /// Reader only: discards everything so far and returns its number; no allocation.
  std::size_t discard() noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed), head = head_.load(std::memory_order_acquire);
    tail_.store(head, std::memory_order_release);
    return (head + ring_.size() - tail) % ring_.size();
  }

  /// Writer only: free entries.
  std::size_t room() const noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed), tail = tail_.load(std::memory_order_acquire);
    return (tail + ring_.size() - head - 1) % ring_.size();
  }

  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<Entry> ring_;
  std::atomic<std::size_t> head_{0}, tail_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace haptics
