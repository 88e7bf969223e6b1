#include "haptics/device/pedal/pedal_switches.h"

#include <linux/input-event-codes.h>

#include <random>

#include <gtest/gtest.h>

namespace haptics {
namespace {

constexpr HandActions kDrill = HandActions{}.with(HandAction::drill);

PedalSwitches axisPedal(AxisRest rest = AxisRest::unknown, int least = 0, int most = 100) {
  return PedalSwitches(std::vector<PedalSwitch>{
      {.is_axis = true, .code = ABS_Z, .threshold = 0.5, .rest = rest, .min = least, .max = most}});
}

TEST(PedalSwitches, AreHeldFromDownToUpAndIgnoreOtherKeys) {
  PedalSwitches pedal(std::vector<PedalSwitch>{{.code = KEY_B}, {.code = KEY_C, .action = HandAction::undo}});
  pedal.takeKey(KEY_A, true);
  EXPECT_EQ(pedal.held(), HandActions{});
  pedal.takeKey(KEY_B, true);
  pedal.takeKey(KEY_C, true);
  EXPECT_EQ(pedal.held(), kDrill.with(HandAction::undo));
  pedal.takeKey(KEY_B, false);
  EXPECT_EQ(pedal.held(), HandActions{}.with(HandAction::undo));
}

TEST(PedalSwitches, CountAKeyThatWasDownAtFirstOnlyAfterItCameUp) {
  PedalSwitches pedal(std::vector<PedalSwitch>{{.code = KEY_B}});
  pedal.beginDown(KEY_B);
  pedal.takeKey(KEY_B, true);
  EXPECT_EQ(pedal.held(), HandActions{});
  pedal.takeKey(KEY_B, false);
  pedal.takeKey(KEY_B, true);
  EXPECT_EQ(pedal.held(), kDrill);
}

TEST(PedalSwitches, PressAnAxisBeyondItsThresholdAndReleaseItATenthBelow) {
  PedalSwitches pedal = axisPedal();
  for (const auto& [value, held] :
       {std::pair{2, false}, {49, false}, {50, true}, {45, true}, {40, true}, {39, false}}) {
    pedal.takeAxis(ABS_Z, value);
    EXPECT_EQ(pedal.held() == kDrill, held) << value;
  }
}

TEST(PedalSwitches, TakeAnAxisThatRestsAtItsHighEndTheOtherWayRound) {
  PedalSwitches pedal = axisPedal();
  pedal.takeAxis(ABS_Z, 98);
  EXPECT_EQ(pedal.held(), HandActions{});
  pedal.takeAxis(ABS_Z, 10);
  EXPECT_EQ(pedal.held(), kDrill);
  pedal.takeAxis(ABS_Z, 70);
  EXPECT_EQ(pedal.held(), HandActions{});
}

TEST(PedalSwitches, IgnoreAnAxisUntilItWasUp) {
  PedalSwitches between = axisPedal();
  between.takeAxis(ABS_Z, 60);
  EXPECT_EQ(between.held(), HandActions{}) << "no end seen yet";
  PedalSwitches held_at_start = axisPedal(AxisRest::low);
  held_at_start.takeAxis(ABS_Z, 100);
  EXPECT_EQ(held_at_start.held(), HandActions{}) << "down when found";
  held_at_start.takeAxis(ABS_Z, 0);
  held_at_start.takeAxis(ABS_Z, 100);
  EXPECT_EQ(held_at_start.held(), kDrill);
}

TEST(PedalSwitches, OnceSeenUpFollowAnAxisAsThePlainRuleDoes) {
  std::mt19937 random(5);
  for (int run = 0; run < 200; ++run) {
    const int least = std::uniform_int_distribution(-40'000, 0)(random);
    const int most = least + std::uniform_int_distribution(10, 70'000)(random);
    PedalSwitches pedal = axisPedal(AxisRest::high, least, most);
    pedal.takeAxis(ABS_Z, most);
    bool held = false;
    for (int i = 0; i < 100; ++i) {
      // Beyond the ends too: calibrations are rarely right.
      const int value = std::uniform_int_distribution(least - 100, most + 100)(random);
      pedal.takeAxis(ABS_Z, value);
      const double travel = (static_cast<double>(most) - value) / (static_cast<double>(most) - least);
      held = travel >= 0.5 || (held && travel >= 0.4);
      ASSERT_EQ(pedal.held() == kDrill, held) << travel;
    }
  }
}

TEST(PedalSwitches, IgnoreAnAxisWithoutRange) {
  PedalSwitches pedal = axisPedal(AxisRest::low, 7, 7);
  pedal.takeAxis(ABS_Z, 7);
  pedal.takeAxis(ABS_Z, 1'000'000);
  EXPECT_EQ(pedal.held(), HandActions{});
}

}  // namespace
}  // namespace haptics
