#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include <fmt/core.h>

#include "app/doctor/checks.h"
#include "haptics/loop/realtime.h"

namespace app {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000, kPeriod_ns = 1'000'000;
constexpr std::size_t kWakeUps = 500;
constexpr double kPunctual_us = 250.0;  ///< a quarter of a tick

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * kNsPerSecond + t.tv_nsec;
}

/// On absolute deadlines, as the servo does.
void wakeUp(int priority, std::vector<double>& late_us) {
  haptics::requestRealtime(priority);
  std::int64_t due_ns = now_ns();
  for (double& late : late_us) {
    due_ns += kPeriod_ns;
    const timespec due{static_cast<time_t>(due_ns / kNsPerSecond), static_cast<long>(due_ns % kNsPerSecond)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
    }
    late = 1e-3 * static_cast<double>(now_ns() - due_ns);
  }
}

}  // namespace

WakeUps measureWakeUps(int servo_priority) {
  std::vector<double> late_us(kWakeUps);
  std::thread(wakeUp, servo_priority, std::ref(late_us)).join();
  munlockall();
  std::ranges::sort(late_us);
  return {late_us[kWakeUps / 2], late_us[kWakeUps * 99 / 100], late_us.back()};
}

Finding checkWakeUps(const WakeUps& measured) {
  Finding finding{
      "wake-up", Health::ok,
      fmt::format("A servo at 1 kHz woke {:.0f} µs late in the middle, {:.0f} µs at 99 %, {:.0f} µs at worst.",
                  measured.median_us, measured.p99_us, measured.worst_us)};
  if (measured.p99_us > kPunctual_us) {
    finding.health = Health::warn;
    finding.next_step = "Mend priority-limit and processors below, and close programs that work in the background.";
  }
  return finding;
}

}  // namespace app
