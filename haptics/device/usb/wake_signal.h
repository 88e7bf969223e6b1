// A signal from any thread to one that sleeps until it or a deadline: an eventfd. raise() is one system call that does
// not block, lock or allocate, and may be called from a signal handler. Raised twice before anybody looked, it is one.
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
  /// The sleeper: true when raised before `deadline_ns` of CLOCK_MONOTONIC.
  bool awaitUntil(std::int64_t deadline_ns) noexcept;
  /// The sleeper: forget that it was raised.
  void lower() noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace haptics
