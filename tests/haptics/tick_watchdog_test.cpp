#include "haptics/loop/tick_watchdog.h"

#include <gtest/gtest.h>

namespace haptics {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(TickWatchdog, MissesNothingBeforeTheFirstTick) {
  // Real-time priority and locked memory may take longer than 50 ms; the motors are off until a tick commands them.
  TickWatchdog watch;
  for (std::int64_t ms = 0; ms < 10'000; ms += 10) EXPECT_FALSE(watch.hasExpired(0, ms * kMillisecond_ns));
}

TEST(TickWatchdog, HearsSilenceAfterFiftyMillisecondsWithoutATickAndTheNextTickEndsIt) {
  TickWatchdog watch;
  const std::int64_t from_ns = 3'000 * kMillisecond_ns;
  EXPECT_FALSE(watch.hasExpired(1, from_ns));
  EXPECT_FALSE(watch.hasExpired(2, from_ns + 40 * kMillisecond_ns));
  EXPECT_FALSE(watch.hasExpired(2, from_ns + 90 * kMillisecond_ns));
  EXPECT_TRUE(watch.hasExpired(2, from_ns + 90 * kMillisecond_ns + 1));
  EXPECT_TRUE(watch.hasExpired(2, from_ns + 500 * kMillisecond_ns)) << "at every look";
  EXPECT_FALSE(watch.hasExpired(3, from_ns + 510 * kMillisecond_ns));
}

}  // namespace
}  // namespace haptics
