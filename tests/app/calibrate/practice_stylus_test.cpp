#include "app/calibrate/practice_stylus.h"

#include <gtest/gtest.h>

#include "app/calibrate/practice_input.h"

namespace app {
namespace {

using calibration::Point;
using calibration::Scenario;
using calibration::Vector;
using calibration::World;

constexpr double kTick_s = 0.001;

class PracticeStylusTest : public testing::Test {
 protected:
  haptics::HandleState after(PracticeStylus& stylus, double seconds) {
    haptics::HandleState state;
    for (double t = 0.0; t < seconds; t += kTick_s) state = stylus.exchange({}, kTick_s);
    return state;
  }

  calibration::SyntheticRig rig_ = calibration::syntheticRig(Scenario::d, 7);
  PracticePose start_{.tip_W = {{0.0, 0.0, 0.0}}};
};

TEST_F(PracticeStylusTest, ItsTipIsTrulyWhereTheHandWantsIt) {
  PracticeStylus stylus(rig_, start_, 0.0);
  for (const glm::dvec3 place : {glm::dvec3(20.0, 10.0, 15.0), glm::dvec3(-40.0, -20.0, -20.0)}) {
    stylus.setPose({.tip_W = {place}, .along_W = {glm::normalize(glm::dvec3(0.3, 0.3, 0.9))}});
    after(stylus, 2.0);
    EXPECT_LT(glm::distance(stylus.seen().tip_W.mm, place), 1e-3);
    EXPECT_LT(glm::distance(stylus.seen().along_W.xyz, glm::normalize(glm::dvec3(0.3, 0.3, 0.9))), 1e-3);
  }
}

TEST_F(PracticeStylusTest, ItsSensorsReadWhatTheUntrueArmWouldAndItsDriverIsMistaken) {
  PracticeStylus stylus(rig_, start_, 0.0);
  const haptics::HandleState state = after(stylus, 1.0);
  ASSERT_TRUE(state.has_joints);
  EXPECT_LT(glm::distance(rig_.tip_W(state.joints_rad).mm, stylus.seen().tip_W.mm), 0.4);  // steps of the gimbal
  const glm::dvec3 believed = (rig_.X_WD * (state.X_DH * Point<calibration::Handle>{calibration::kNominalTip_H_mm})).mm;
  EXPECT_GT(glm::distance(believed, stylus.seen().tip_W.mm), 0.3);
}

TEST_F(PracticeStylusTest, AHandTremblesAndLessSoInAPit) {
  const auto trembles = [&](bool steadied) {
    PracticeStylus stylus(rig_, start_, 0.05);
    PracticePose hold = start_;
    hold.steadied = steadied;
    stylus.setPose(hold);
    after(stylus, 1.0);
    double sum = 0.0;
    for (int n = 0; n < 2000; ++n) {
      stylus.exchange({}, kTick_s);
      const double off = glm::distance(stylus.seen().tip_W.mm, start_.tip_W.mm);
      sum += off * off;
    }
    return std::sqrt(sum / 2000.0);
  };
  EXPECT_NEAR(trembles(false), 0.05, 0.02);
  EXPECT_NEAR(trembles(true), 0.01, 0.005);
}

TEST_F(PracticeStylusTest, IsBelievedOnceItHasBeenInItsInkwellAsARealOne) {
  PracticeStylus stylus(rig_, start_);
  EXPECT_FALSE(after(stylus, 0.5).calibrated);
  PracticePose hold = start_;
  hold.in_inkwell = true;
  stylus.setPose(hold);
  EXPECT_TRUE(after(stylus, 0.5).docked);
  stylus.setPose(start_);
  const haptics::HandleState out = after(stylus, 2.0);
  EXPECT_FALSE(out.docked);
  EXPECT_TRUE(out.calibrated);
}

TEST_F(PracticeStylusTest, WhatIsNoHoldIsIgnored) {
  PracticeStylus stylus(rig_, start_, 0.0);
  stylus.setPose({.tip_W = {{std::nan(""), 0.0, 0.0}}, .button = true});
  stylus.setPose({.tip_W = {{0.0, 0.0, 0.0}}, .along_W = {{0.0, 0.0, 0.0}}, .button = true});
  EXPECT_EQ(after(stylus, 0.2).buttons, 0u);
  EXPECT_LT(glm::length(stylus.seen().tip_W.mm), 0.01);
}

TEST_F(PracticeStylusTest, BeyondItsReachItStandsStillAndSaysNothingThatIsNotFinite) {
  PracticeStylus stylus(rig_, start_, 0.0);
  stylus.setPose({.tip_W = {{4000.0, 0.0, 0.0}}});
  const haptics::HandleState state = after(stylus, 2.0);
  for (const double angle : state.joints_rad) EXPECT_TRUE(std::isfinite(angle));
  EXPECT_LT(glm::length(state.X_DH.translation_mm), 400.0);
}

TEST(PracticeInput, ADragMovesTheTipInTheScreensPlaneAndTheWheelInDepth) {
  PracticeInput hand({.tip_W = {{1.0, 2.0, 3.0}}}, 1);
  const glm::dvec3 across(0.25, 0.0, 0.0), up(0.0, 0.25, 0.0);
  hand.take(render::PointerMoved{.to_px = {}, .by_px = {40.0, 20.0}, .button = render::MouseButton::left}, across, up);
  hand.take(render::PointerMoved{.to_px = {}, .by_px = {99.0, 99.0}, .button = render::MouseButton::none}, across, up);
  hand.take(render::WheelTurned{.notches = 2.0}, across, up);
  EXPECT_LT(glm::distance(hand.pose({}).tip_W.mm, glm::dvec3(11.0, -3.0, 1.0)), 1e-9);
}

TEST(PracticeInput, KeysTiltItPressItsButtonAndPutItIntoTheInkwell) {
  PracticeInput hand({}, 1);
  const glm::dvec3 across(0.25, 0.0, 0.0), up(0.0, 0.25, 0.0);
  const auto press = [&](render::Key key, bool down) {
    hand.take(render::KeyPressed{.key = key, .down = down}, across, up);
  };
  const glm::dvec3 before = hand.pose({}).along_W.xyz;
  press(render::Key::right, true);
  EXPECT_GT(hand.pose({}).along_W.xyz.x, before.x + 0.03);
  press(render::Key::space, true);
  EXPECT_TRUE(hand.pose({}).button);
  press(render::Key::space, false);
  for (int n = 0; n < 3; ++n) hand.pose({});
  EXPECT_FALSE(hand.pose({}).button);
  press(render::keyOf('H'), true);
  EXPECT_TRUE(hand.pose({}).in_inkwell);
}

TEST(PracticeInput, APitDrawsTheTipInAndHoldsItSteady) {
  PracticeInput hand({.tip_W = {{8.0, 2.0, 1.0}}}, 1);
  WizardView view;
  view.target_kind = calibration::TargetKind::pit;
  view.targets.push_back({{{10.0, 0.0, 0.0}}, {{0.0, 0.0, 1.0}}, TargetState::next, "1"});
  const PracticePose held = hand.pose(view);
  EXPECT_TRUE(held.steadied);
  EXPECT_LT(glm::distance(held.tip_W.mm, glm::dvec3(10.0, 0.0, 0.0)), 0.3);
  EXPECT_EQ(hand.pose(view).tip_W.mm, held.tip_W.mm);  // it does not jump about in it
  hand.take(render::WheelTurned{.notches = -5.0}, {0.25, 0.0, 0.0}, {0.0, 0.25, 0.0});
  EXPECT_FALSE(hand.pose(view).steadied);
}

}  // namespace
}  // namespace app
