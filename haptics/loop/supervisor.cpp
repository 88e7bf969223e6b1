#include "haptics/loop/supervisor.h"

#include <chrono>

#include "haptics/device/monotonic_clock.h"
#include "haptics/loop/tick_watchdog.h"

namespace haptics {
namespace {

constexpr auto kLook = std::chrono::milliseconds(10);

}  // namespace

Supervisor::Supervisor(HapticDevice& device, const std::atomic<std::uint64_t>& ticks)
    : device_(device), ticks_(ticks), thread_([this] { watch(); }) {}

Supervisor::~Supervisor() { end(); }

void Supervisor::end() noexcept {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_one();
  thread_.join();
}

void Supervisor::watch() noexcept {
  TickWatchdog watch;
  bool was_silent = false;
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, kLook, [this] { return is_over_; })) {
    const bool silent = watch.hasExpired(ticks_.load(std::memory_order_relaxed), monotonic_ns());
    // Again at every look: what a late tick may still have told the motors does not last.
    if (silent) device_.motorsOff();
    if (silent && !was_silent) trips_.fetch_add(1, std::memory_order_relaxed);
    was_silent = silent;
  }
}

}  // namespace haptics
