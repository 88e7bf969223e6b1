#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "haptics/servo/elevator.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/socketed_tooth.h"

namespace haptics {
namespace {

using namespace phantom;

glm::dquat twisted(double rad) { return glm::angleAxis(rad, glm::dvec3(0.0, 0.0, 1.0)); }

/// A straight elevator over a gutter beside a tooth, its width along the gutter.
struct Levered : Mouth {
  static constexpr glm::dvec3 kAbove_mm{3.5, 0.0, 8.0}, kInGutter_mm{3.05, 0.0, -1.6};
  const glm::dquat along = twisted(1.5708);

  Levered() : Mouth(true) {
    command.tool = elevatorTool(ElevatorKind::straight_301);
    hand.X_PT = {along, kAbove_mm};
    step();
  }
  void insert() { go(kInGutter_mm, 0.5, along); }
  void twist(double rad, double seconds = 0.3) { go(kInGutter_mm, seconds, along * twisted(rad)); }
  void lift() {
    go(kAbove_mm, 0.4, along);
    step(400);
  }
};

TEST(ServoElevator, ItsTipMeetsBoneAndTeethAlsoWhereNothingIsReady) {
  Levered mouth;
  mouth.go({6.0, 0.0, -1.0}, 0.5, mouth.along);
  EXPECT_GT(mouth.tick.law_force_P_N.xyz.z, 0.1);
  EXPECT_GT(mouth.tick.proxy_P.mm.z, 0.0);
  EXPECT_EQ(mouth.tick.lever, Levering{});
  mouth.hand.drill_pedal = true;
  mouth.step(20);
  EXPECT_FALSE(mouth.tick.drilling);
  EXPECT_EQ(mouth.tick.removed_mm3, 0.0);
}

TEST(ServoElevator, NearAPieceTheWholeBladeIsHeldOffBone) {
  Levered mouth;
  mouth.makeReady();
  ASSERT_EQ(mouth.tick.site, SiteAnswer::ready);
  // Across the gutter the blade is 3 mm wide, the gutter less than 2.
  mouth.go({5.4, 0.0, 5.0}, 0.3, twisted(0.0));
  mouth.go({5.4, 0.0, 1.0}, 0.2, twisted(0.0));
  mouth.go({5.4, 0.0, -1.0}, 0.5, twisted(0.0));
  EXPECT_EQ(mouth.tick.lever.piece, 0);
  EXPECT_GT(mouth.tick.lever.on_bone_N, 15.0);
  EXPECT_EQ(mouth.tick.lever.on_piece_N, 0.0);
  EXPECT_GT(mouth.tick.proxy_P.mm.z, -0.2);
  EXPECT_NEAR(glm::length(mouth.tick.law_force_P_N.xyz),
              0.5 * glm::distance(mouth.tick.proxy_P.mm, mouth.hand.X_PT.translation_mm), 0.02);
  EXPECT_EQ(mouth.tick.strokes, 0) << "no piece was moved";
}

TEST(ServoElevator, TwistsLoosenATooth) {
  Levered mouth;
  mouth.makeReady();
  mouth.insert();
  mouth.twist(0.0);
  mouth.twist(0.7);
  ASSERT_EQ(mouth.tick.lever.piece, 1);
  EXPECT_EQ(mouth.tick.gripped, 0);
  EXPECT_GT(std::abs(mouth.tick.lever.twist_Nmm), 200.0);
  EXPECT_GT(mouth.tick.lever.on_piece_N, 30.0);
  EXPECT_GT(mouth.tick.lever.on_bone_N, 30.0) << "the wall is the fulcrum";
  EXPECT_EQ(mouth.tick.lever.on_teeth_N, 0.0);
  const double after_one = mouth.tick.torn_share;
  for (int n = 0; n < 60 && mouth.tick.torn_share < 0.9; ++n) mouth.twist(n % 2 == 0 ? -0.9 : 0.9);
  EXPECT_GT(mouth.tick.torn_share, after_one);
  EXPECT_GT(mouth.tick.torn_share, 0.9);
  EXPECT_EQ(mouth.tick.strokes, 1);
}

TEST(ServoElevator, WhatTearsIsFeltAsPulsesWhereTheDeviceHasNoTorque) {
  double farthest_N[2] = {}, torn_Nmm[2] = {};
  for (const bool turns : {false, true}) {
    Levered mouth;
    mouth.command.safety.peak_torque_Nmm = turns ? 100.0 : 0.0;
    mouth.makeReady();
    mouth.insert();
    for (int n = 0; n < 2000; ++n) {
      mouth.hand.X_PT.rotation = mouth.along * twisted(0.9 * std::sin(0.01 * n));
      mouth.step();
      const double off_N = glm::distance(mouth.tick.commanded_force_P_N.xyz, mouth.tick.law_force_P_N.xyz);
      // After the fade of taking hold.
      if (n > 100) farthest_N[turns] = std::max(farthest_N[turns], off_N);
    }
    torn_Nmm[turns] = mouth.tick.torn_total_Nmm;
  }
  EXPECT_GT(torn_Nmm[0], 10.0);
  EXPECT_EQ(torn_Nmm[0], torn_Nmm[1]) << "the model is the same";
  EXPECT_GT(farthest_N[0], farthest_N[1] + 0.15);
}

TEST(ServoElevator, AWorkIsAStrokeThatIsUndoneOnceTheBladeIsOff) {
  Levered mouth;
  mouth.makeReady();
  const PiecePose before = mouth.tick.X_PQ[0];
  mouth.insert();
  for (int n = 0; n < 20; ++n) mouth.twist(n % 2 == 0 ? -0.9 : 0.9);
  ASSERT_GT(mouth.tick.torn_share, 0.02);
  ++mouth.command.undo_serial;
  mouth.step(5);
  EXPECT_EQ(mouth.tick.strokes, 1) << "not while the blade is at work";
  const double torn_share = mouth.tick.torn_share, torn_Nmm = mouth.tick.torn_total_Nmm;
  mouth.lift();
  ASSERT_EQ(mouth.tick.lever.piece, 0);
  const PiecePose after = mouth.tick.X_PQ[0];
  ++mouth.command.undo_serial;
  mouth.step(50);
  EXPECT_EQ(mouth.tick.strokes, 0);
  EXPECT_EQ(mouth.tick.X_PQ[0].translation_mm, before.translation_mm);
  EXPECT_EQ(mouth.tick.torn_total_Nmm, 0.0);
  EXPECT_EQ(mouth.tick.torn_share, 0.0);
  ++mouth.command.redo_serial;
  mouth.step(50);
  EXPECT_EQ(mouth.tick.X_PQ[0].translation_mm, after.translation_mm);
  EXPECT_GE(mouth.tick.torn_total_Nmm, torn_Nmm);
  EXPECT_GE(mouth.tick.torn_share, torn_share);
}

TEST(ServoElevator, ThePedalKeepsTheRollWhileTheHandTurnsBack) {
  Levered mouth;
  mouth.makeReady();
  mouth.insert();
  mouth.twist(0.5);
  const double twist_Nmm = mouth.tick.lever.twist_Nmm;
  ASSERT_GT(std::abs(twist_Nmm), 100.0);
  mouth.hand.drill_pedal = true;
  mouth.twist(0.0);
  EXPECT_NEAR(mouth.tick.lever.twist_Nmm, twist_Nmm, 0.1 * std::abs(twist_Nmm));
  mouth.hand.drill_pedal = false;
  mouth.step(50);
  EXPECT_NEAR(mouth.tick.lever.twist_Nmm, twist_Nmm, 0.1 * std::abs(twist_Nmm)) << "it goes on from there";
  mouth.twist(0.5);
  EXPECT_GT(std::abs(mouth.tick.lever.twist_Nmm), 1.3 * std::abs(twist_Nmm));
}

TEST(ServoElevator, AnotherToolLeavesTheTooth) {
  Levered mouth;
  mouth.makeReady();
  mouth.insert();
  mouth.twist(0.5);
  ASSERT_EQ(mouth.tick.lever.piece, 1);
  mouth.command.tool = forcepsTool();
  mouth.step(2);
  EXPECT_EQ(mouth.tick.lever, Levering{});
  mouth.command.tool = elevatorTool(ElevatorKind::cryer_left);
  mouth.step(400);
  EXPECT_LT(glm::length(mouth.tick.X_PQ[0].translation_mm), 0.3);
}

TEST(ServoElevator, ForceIsBoundedWhateverTheHandDoesAndTheSameTwice) {
  Levered mouths[2];
  for (Levered& mouth : mouths) mouth.makeReady();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> jump(-4.0, 4.0), turn(-1.0, 1.0);
  int at_work = 0;
  for (int n = 0; n < 3000; ++n) {
    HandSample& hand = mouths[0].hand;
    if (n % 60 == 0) {
      hand.X_PT.translation_mm = Levered::kInGutter_mm + glm::dvec3(jump(random), jump(random), jump(random));
      hand.X_PT.rotation = glm::normalize(glm::dquat(1.0, turn(random), turn(random), turn(random)));
    }
    if (n % 900 == 899) hand.X_PT.translation_mm.x = std::nan("");
    hand.drill_pedal = n % 500 < 100;
    mouths[0].command.tool = elevatorTool(static_cast<ElevatorKind>(1 + n / 750));
    mouths[1].hand = hand;
    mouths[1].command.tool = mouths[0].command.tool;
    for (Levered& mouth : mouths) mouth.step();
    const Tick &a = mouths[0].tick, &b = mouths[1].tick;
    ASSERT_LE(glm::length(a.commanded_force_P_N.xyz), mouths[0].command.safety.peak_force_N + 1e-9);
    ASSERT_LE(std::abs(a.lever.twist_Nmm), 2000.1);
    ASSERT_TRUE(calibration::isFinite(a.X_PQ[0].translation_mm));
    ASSERT_EQ(a.lever, b.lever);
    ASSERT_EQ(a.X_PQ[0].translation_mm, b.X_PQ[0].translation_mm);
    ASSERT_EQ(a.commanded_force_P_N.xyz, b.commanded_force_P_N.xyz);
    at_work += a.lever.piece != 0;
  }
  EXPECT_GT(at_work, 100);
}

}  // namespace
}  // namespace haptics
