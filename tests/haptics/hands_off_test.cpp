// Hands off by command: as if the deadman felt no hand.
#include <gtest/gtest.h>

#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

constexpr double kOut_mm = 6.0, kIn_mm = 0.0;

/// A bur pressed a millimetre and a half into flat bone, of a device with motors or without.
struct Pressed {
  Bodies bone = halfSpace(12.0, 0.25).bodies(1);
  Servo servo{bone};
  Command command;
  HandSample hand;
  Tick tick;
  double most_jump_N = 0.0;

  explicit Pressed(bool has_motors) {
    command.tool.head.radius_mm = 1.5;
    if (has_motors) command.safety = strict(command.safety);
    for (int n = 0; n < 1500; ++n) at(kOut_mm);
    for (int n = 0; n <= 300; ++n) at(kOut_mm - 0.02 * n);
    for (int n = 0; n < 600; ++n) at(kIn_mm);
    most_jump_N = 0.0;
  }
  void at(double z_mm) {
    hand.handle_velocity_P_mm_per_s.xyz = hand.velocity_P_mm_per_s.xyz = {
        0.0, 0.0, (z_mm - hand.X_PT.translation_mm.z) * 1e3 * (tick.dt_s > 0.0 ? 1.0 : 0.0)};
    hand.X_PT.translation_mm = {0.0, 0.0, z_mm};
    const double before_N = force_N();
    tick = servo.step(hand, command, 1e-3);
    most_jump_N = std::max(most_jump_N, std::abs(force_N() - before_N));
  }
  double force_N() const { return glm::length(tick.commanded_force_P_N.xyz); }
};

class HandsOff : public ::testing::TestWithParam<bool> {};

TEST_P(HandsOff, TheForceFadesWithinATwentiethOfASecondWithoutAJump) {
  Pressed pressed(GetParam());
  const double before_N = pressed.force_N();
  ASSERT_GT(before_N, 0.5);
  pressed.command.hands_off = true;
  for (int n = 0; n < 60; ++n) {
    pressed.at(kIn_mm);
    EXPECT_FALSE(has(pressed.tick.faults, Fault::let_go)) << "it was asked for";
  }
  EXPECT_EQ(pressed.force_N(), 0.0);
  EXPECT_LT(pressed.most_jump_N, 0.31) << "the slew limit";
  EXPECT_EQ(pressed.tick.state, SafetyState::ready);
}

TEST_P(HandsOff, NothingTurnsUntilThePedalWasUpAfterwards) {
  Pressed pressed(GetParam());
  const auto drills = [&](int ticks) {
    bool any = false;
    for (int n = 0; n < ticks; ++n) pressed.at(kIn_mm), any = any || pressed.tick.drilling;
    return any;
  };
  pressed.command.hands_off = true;
  pressed.hand.drill_pedal = true;
  EXPECT_FALSE(drills(200));
  pressed.command.hands_off = false;
  for (int n = 0; n < 300; ++n) pressed.at(kIn_mm + 0.02 * n);
  for (int n = 0; n < 1500; ++n) pressed.at(kOut_mm);
  EXPECT_EQ(pressed.tick.state, SafetyState::active);
  EXPECT_FALSE(pressed.tick.drilling) << "down since before";
  pressed.hand.drill_pedal = false;
  pressed.at(kOut_mm);
  pressed.hand.drill_pedal = true;
  pressed.at(kOut_mm);
  EXPECT_TRUE(pressed.tick.drilling);
}

INSTANTIATE_TEST_SUITE_P(Motors, HandsOff, ::testing::Bool());

TEST(HandsOffWithMotors, InTheBoneTheForceComesBackOnlyOutOfItAndSoftly) {
  Pressed pressed(true);
  pressed.command.hands_off = true;
  for (int n = 0; n < 100; ++n) pressed.at(kIn_mm);
  pressed.command.hands_off = false;
  for (int n = 0; n < 500; ++n) {
    pressed.at(kIn_mm);
    ASSERT_EQ(pressed.force_N(), 0.0) << "still in the bone";
  }
  for (int n = 0; n < 300; ++n) pressed.at(kIn_mm + 0.02 * n);
  for (int n = 0; n < 300; ++n) pressed.at(kOut_mm);
  EXPECT_EQ(pressed.tick.state, SafetyState::active);
  pressed.most_jump_N = 0.0;
  for (int n = 0; n <= 300; ++n) pressed.at(kOut_mm - 0.02 * n);
  for (int n = 0; n < 1500; ++n) pressed.at(kIn_mm);
  EXPECT_GT(pressed.force_N(), 0.5);
  EXPECT_LT(pressed.most_jump_N, 0.31);
}

}  // namespace
}  // namespace haptics
