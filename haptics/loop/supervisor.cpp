#include "haptics/loop/supervisor.h"

#include <chrono>

namespace haptics {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(10);
constexpr auto kLongestSilence = std::chrono::milliseconds(50);

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
  std::uint64_t seen = ticks_.load(std::memory_order_relaxed);
  Clock::time_point seen_at = Clock::now();
  bool silent = false;
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, kLook, [this] { return is_over_; })) {
    const Clock::time_point now = Clock::now();
    if (const std::uint64_t ticks = ticks_.load(std::memory_order_relaxed); ticks != seen) {
      seen = ticks;
      seen_at = now;
      silent = false;
    } else if (now - seen_at > kLongestSilence) {
      // Again at every look: what a late tick may still have told the motors does not last.
      device_.motorsOff();
      if (!silent) trips_.fetch_add(1, std::memory_order_relaxed);
      silent = true;
    }
  }
}

}  // namespace haptics
