// Triple buffer, newest wins: one writer passes values to one reader through three slots and one atomic. Both sides
// wait-free, no allocation; the reader never sees a torn or an older value. T must own nothing (trivially
// destructible). Values in between are lost.
#pragma once

#include <array>
#include <atomic>
#include <type_traits>

namespace haptics {

template <class T>
class Latest {
  static_assert(std::is_trivially_destructible_v<T>, "what crosses threads owns nothing");

 public:
  explicit Latest(const T& first = T{}) : slots_{first, first, first} {}

  /// Writer only.
  void publish(const T& value) {
    slots_[writing_] = value;
    const unsigned taken = middle_.exchange(writing_ | kFresh, std::memory_order_acq_rel);
    writing_ = taken & kSlotMask;
  }

  /// Reader only: the newest published value; the first one until something is published.
  const T& read() {
    if (middle_.load(std::memory_order_relaxed) & kFresh) {
      const unsigned taken = middle_.exchange(reading_, std::memory_order_acq_rel);
      reading_ = taken & kSlotMask;
    }
    return slots_[reading_];
  }

 private:
  static constexpr unsigned kSlotMask = 3, kFresh = 4;
  std::array<T, 3> slots_;
  unsigned writing_ = 0;
  std::atomic<unsigned> middle_{1};
  unsigned reading_ = 2;
};

}  // namespace haptics
