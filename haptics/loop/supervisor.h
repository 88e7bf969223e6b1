// Watches from a thread of its own that ticks come, and switches the motors off while they do not (silence_watch).
// Looks every 10 ms by the machine's clock. Says how often it had to. One other thread constructs, ends and destroys
// it.
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
  /// Watches from now on. Borrows both.
  Supervisor(HapticDevice& device, const std::atomic<std::uint64_t>& ticks);
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Watches no longer; what it counted stays. Also twice.
  void end() noexcept;

  /// Any thread.
  std::uint64_t trips() const { return trips_.load(std::memory_order_relaxed); }

 private:
  void watch() noexcept;

  HapticDevice& device_;
  const std::atomic<std::uint64_t>& ticks_;
  std::atomic<std::uint64_t> trips_{0};
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace haptics
