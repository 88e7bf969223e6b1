// An eventfd that wakes one thread before its deadline. raise(), from any thread or a signal handler, is one system
// call that neither blocks nor allocates. Raised repeatedly before it is read, it counts once.
#pragma once

#include <cstdint>

namespace haptics {

class WakeSignal {
 public:
  /// Throws DeviceError when the system has no descriptor left.
  WakeSignal();
  ~WakeSignal();
  WakeSignal(const WakeSignal&) = delete;
  WakeSignal& operator=(const WakeSignal&) = delete;

  void raise() noexcept;
  /// The waiting thread: true when raised before `deadline_ns` of CLOCK_MONOTONIC.
  bool awaitUntil(std::int64_t deadline_ns) noexcept;
  /// The waiting thread: clears it.
  void lower() noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace haptics
