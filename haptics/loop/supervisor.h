// Switches the motors off from a thread of its own while no ticks come (tick_watchdog). Checks every 10 ms on the
// machine's clock and counts. One other thread constructs, ends and destroys it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "haptics/device/haptic_device.h"

namespace haptics {

class Supervisor {
 public:
  /// Starts watching. Borrows both.
  Supervisor(HapticDevice& device, const std::atomic<std::uint64_t>& ticks);
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Stops watching; the count stays. May be called twice.
  void end() noexcept;

  /// Any thread.
  std::uint64_t trips() const { return trips_.load(std::memory_order_relaxed); }

 private:
  void watch() noexcept;

  HapticDevice& device_;
  const std::atomic<std::uint64_t>& ticks_;
  std::atomic<std::uint64_t> trips_{0};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace haptics
