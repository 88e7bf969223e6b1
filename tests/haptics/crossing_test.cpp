#include <gtest/gtest.h>

#include <thread>

#include "haptics/latest.h"
#include "haptics/servo/tick_log.h"

namespace haptics {
namespace {

TEST(Latest, GivesTheFirstValueUntilSomethingIsPublished) {
  Latest<int> latest(7);
  EXPECT_EQ(latest.read(), 7);
  latest.publish(8);
  latest.publish(9);
  EXPECT_EQ(latest.read(), 9);
  EXPECT_EQ(latest.read(), 9);
}

TEST(Latest, IsNeverTornAndNeverGoesBack) {
  struct Pair {
    std::uint64_t a = 0, b = 0, c = 0, d = 0;
  };
  Latest<Pair> latest;
  constexpr std::uint64_t kValues = 200'000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kValues; ++i) latest.publish({i, ~i, i * 3, i * 5});
  });
  std::uint64_t last = 0;
  while (last < kValues) {
    const Pair& pair = latest.read();
    if (pair.a == 0) continue;
    ASSERT_EQ(pair.b, ~pair.a);
    ASSERT_EQ(pair.c, pair.a * 3);
    ASSERT_EQ(pair.d, pair.a * 5);
    ASSERT_GE(pair.a, last);
    last = pair.a;
  }
  writer.join();
}

TEST(TickLog, HandsOverEveryTickInOrder) {
  TickLog log(64);
  constexpr std::uint64_t kTicks = 20'000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kTicks; ++i) {
      Tick tick;
      tick.index = i;
      tick.bone_digest = i * 7;
      log.push(tick);
    }
  });
  std::vector<Tick> ticks;
  while (ticks.size() + log.dropped() < kTicks) log.drainInto(ticks);
  writer.join();
  log.drainInto(ticks);
  EXPECT_EQ(ticks.size() + log.dropped(), kTicks);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    ASSERT_EQ(ticks[i].bone_digest, ticks[i].index * 7);
    ASSERT_TRUE(i == 0 || ticks[i].index > ticks[i - 1].index);
  }
}

TEST(TickLog, DropsAndCountsWhenNobodyReads) {
  TickLog log(10);
  for (int i = 0; i < 25; ++i) log.push({});
  std::vector<Tick> ticks;
  log.drainInto(ticks);
  EXPECT_EQ(ticks.size(), 10u);
  EXPECT_EQ(log.dropped(), 15u);
}

}  // namespace
}  // namespace haptics
