// CLOCK_MONOTONIC in nanoseconds, on which paced devices and USB deadlines are counted, and a sleep until a time of it.
// Any thread; monotonic_ns() makes no system call on Linux.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace haptics {

inline std::int64_t monotonic_ns() {
  using std::chrono::duration_cast, std::chrono::nanoseconds;
  return duration_cast<nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline timespec timespecOf(std::int64_t time_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  return {static_cast<time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

void sleepUntil(std::int64_t deadline_ns);

}  // namespace haptics
