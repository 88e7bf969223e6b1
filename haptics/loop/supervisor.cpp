#include "haptics/loop/supervisor.h"

#include <chrono>

#include "haptics/device/monotonic_clock.h"
#include "haptics/loop/tick_watchdog.h"

namespace haptics {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(10);

}  // namespace

Supervisor::Supervisor(HapticDevice& device, const std::atomic<std::uint64_t>& ticks)
    : device_(device), ticks_(ticks), thread_([this] { watch(); }) {}

Supervisor::~Supervisor() { end(); }

void Supervisor::end() noexcept {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Supervisor::watch() noexcept {
  TickWatchdog watch;
  bool was_expired = false;
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, kPeriod, [this] { return is_ended_; })) {
    const bool expired = watch.hasExpired(ticks_.load(std::memory_order_relaxed), monotonic_ns());
    // At every check, so that the command of a late tick does not last.
    if (expired) device_.motorsOff();
    if (expired && !was_expired) trips_.fetch_add(1, std::memory_order_relaxed);
    was_expired = expired;
  }
}

}  // namespace haptics
