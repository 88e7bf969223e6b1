#include "haptics/device/deadline_grid.h"

#include <gtest/gtest.h>

namespace haptics {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

TEST(DeadlineGrid, StaysOnItsGridHoweverLateATickWakes) {
  DeadlineGrid grid(1000.0, 7);
  for (std::int64_t n = 1; n < 100; ++n) {
    EXPECT_EQ(grid.next_ns(), 7 + n * kMillisecond_ns);
    const TickTiming timing = grid.beginTick(grid.next_ns() + 1000 * (n % 5));
    EXPECT_EQ(timing.late_us, static_cast<double>(n % 5));
    EXPECT_EQ(timing.missed, 0u);
    grid.endTick(grid.next_ns() + 300'000);
  }
}

TEST(DeadlineGrid, SkipsMissedDeadlinesAndCountsThem) {
  DeadlineGrid grid(1000.0, 0);
  grid.beginTick(1 * kMillisecond_ns);
  grid.endTick(4 * kMillisecond_ns + 500'000);  // 2, 3 and 4 ms went by
  EXPECT_EQ(grid.next_ns(), 5 * kMillisecond_ns);
  EXPECT_EQ(grid.beginTick(5 * kMillisecond_ns).missed, 3u);
  grid.endTick(5 * kMillisecond_ns + 1);
  EXPECT_EQ(grid.beginTick(6 * kMillisecond_ns).missed, 0u);
}

TEST(DeadlineGrid, MovesToATickThatComesEarly) {
  DeadlineGrid grid(1000.0, 0);
  const TickTiming timing = grid.beginTick(600'000);
  EXPECT_EQ(timing.late_us, 0.0);
  grid.endTick(700'000);
  EXPECT_EQ(grid.next_ns(), 1'600'000);
}

}  // namespace
}  // namespace haptics
