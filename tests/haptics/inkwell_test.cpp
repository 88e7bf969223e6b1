#include "haptics/device/openhaptics/inkwell.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "haptics/device/openhaptics/callback_timing.h"

namespace haptics {
namespace {

/// Moves by `way_mm` in steps of 0.5 mm with the given state of the switch.
bool travel(Inkwell& inkwell, bool value, double from_mm, double to_mm, bool sure = true) {
  bool docked = false;
  const int steps = static_cast<int>(std::abs(to_mm - from_mm) / 0.5);
  for (int i = 0; i <= steps; ++i)
    docked = inkwell.isDocked(value, {0.0, from_mm + (to_mm - from_mm) * i / std::max(1, steps), 0.0}, sure);
  return docked;
}

TEST(Inkwell, CountsAsDockedUntilItsPolarityIsLearned) {
  for (bool docked_value : {false, true}) {
    Inkwell inkwell;
    EXPECT_EQ(inkwell.dockedValue(), std::nullopt);
    EXPECT_TRUE(travel(inkwell, docked_value, 0.0, 2.0));  // loose in its well
    EXPECT_TRUE(travel(inkwell, !docked_value, 2.0, 30.0));
    EXPECT_EQ(inkwell.dockedValue(), std::nullopt);
    EXPECT_FALSE(travel(inkwell, !docked_value, 30.0, 60.0));
    EXPECT_EQ(inkwell.dockedValue(), docked_value);
    EXPECT_TRUE(travel(inkwell, docked_value, 60.0, 60.5));
    EXPECT_FALSE(travel(inkwell, !docked_value, 60.5, 61.0));
  }
}

TEST(Inkwell, UsesTheSettingUntilMovementContradictsIt) {
  Inkwell inkwell(true);
  EXPECT_FALSE(inkwell.isDocked(false, {}, true));
  EXPECT_TRUE(inkwell.isDocked(true, {}, true));
  EXPECT_FALSE(travel(inkwell, true, 0.0, 60.0));
  EXPECT_EQ(inkwell.dockedValue(), false);
}

TEST(Inkwell, LearnsNothingFromJumpsAndInvalidPositions) {
  Inkwell inkwell;
  EXPECT_TRUE(travel(inkwell, false, 0.0, 300.0, false));
  EXPECT_TRUE(inkwell.isDocked(false, {0.0, 300.0, 0.0}, true));
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(inkwell.isDocked(true, {i % 2 ? 90.0 : 0.0, 0.0, 0.0}, true));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(inkwell.isDocked(true, {nan, i * 1.0, 0.0}, true));
  EXPECT_EQ(inkwell.dockedValue(), std::nullopt);
}

TEST(Inkwell, LearnsNothingFromAStylusThatRattlesInItsInkwell) {
  std::mt19937 seed(7);
  std::uniform_real_distribution<double> rattle(-11.0, 11.0);
  Inkwell inkwell;
  glm::dvec3 place(0.0);
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 wanted(rattle(seed), rattle(seed), rattle(seed));
    place += 0.1 * (wanted - place);
    EXPECT_TRUE(inkwell.isDocked(true, place, true));
  }
  EXPECT_EQ(inkwell.dockedValue(), std::nullopt);
}

TEST(CallbackTiming, ReportsLatenessAndMissedCalls) {
  CallbackTiming timing(1000.0);
  const auto expect = [&](std::int64_t at_us, double late_us, std::uint64_t missed) {
    const TickTiming told = timing.next(at_us * 1000);
    EXPECT_NEAR(told.late_us, late_us, 1e-6) << at_us;
    EXPECT_EQ(told.missed, missed) << at_us;
  };
  expect(50'000, 0.0, 0);
  expect(51'000, 0.0, 0);
  expect(52'200, 200.0, 0);
  expect(52'900, 0.0, 0);
  expect(57'900, 4000.0, 4);
  expect(57'900, 0.0, 0);
}

}  // namespace
}  // namespace haptics
