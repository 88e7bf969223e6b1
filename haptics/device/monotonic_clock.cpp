#include "haptics/device/monotonic_clock.h"

#include <time.h>

#include <cerrno>

namespace haptics {

void sleepUntil(std::int64_t deadline_ns) {
  const timespec deadline = timespecOf(deadline_ns);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace haptics
