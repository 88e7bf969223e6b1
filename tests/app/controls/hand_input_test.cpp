#include "app/controls/hand_input.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"

namespace app {
namespace {

using render::Key;
using render::KeyPressed;

TEST(HandInput, DragsInThePlaneOfTheScreenOneToOne) {
  HandInput hand({});
  hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::left}, 0.25);
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, 0.0));
  hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::none}, 0.25);
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, 0.0)) << "motion without the button has no effect";
}

TEST(HandInput, ANotchOfTheWheelIsTwoFifthsOfTheGapAndNeverPassesTheBone) {
  for (const double gap_mm : {0.5, 1.0, 2.0, 5.0}) {
    HandInput hand({});
    hand.setGap(gap_mm);
    hand.take(render::WheelTurned{1.0}, 0.25);
    EXPECT_NEAR(hand.X_WT().translation_mm.z, -0.4 * gap_mm, 1e-12);
    hand.take(render::WheelTurned{2.0}, 0.25);
    EXPECT_GT(hand.X_WT().translation_mm.z, -gap_mm) << "several notches in one frame";
  }
}

TEST(HandInput, TheWheelIsFineAtTheBoneFastFarAwayAndLeavesQuickly) {
  const auto step_mm = [](std::optional<double> gap_mm, double notches, bool shift) {
    HandInput hand({});
    hand.setGap(gap_mm);
    if (shift) hand.take(KeyPressed{Key::left_shift, true, false, true}, 0.25);
    hand.take(render::WheelTurned{notches}, 0.25);
    return -hand.X_WT().translation_mm.z;
  };
  EXPECT_NEAR(step_mm(0.0, 1.0, false), 0.1, 1e-12);
  EXPECT_NEAR(step_mm({}, 1.0, false), 2.0, 1e-12) << "no bone within 10 mm";
  EXPECT_NEAR(step_mm(0.0, -1.0, false), -0.3, 1e-12);
  EXPECT_NEAR(step_mm(0.0, -1.0, true), -1.5, 1e-12);
  EXPECT_NEAR(step_mm(5.0, 0.5, false), 1.0, 1e-12) << "half a notch of a touch pad";
}

TEST(HandInput, FindsContactFromFiveMillimetresInTenNotches) {
  HandInput hand({});
  int notches = 0;
  for (double gap_mm = 5.0; gap_mm > 0.0 && notches < 100; ++notches) {
    hand.setGap(gap_mm);
    hand.take(render::WheelTurned{1.0}, 0.25);
    gap_mm = 5.0 + hand.X_WT().translation_mm.z;
  }
  EXPECT_LE(notches, 10);
}

TEST(HandInput, LeavesADeepHoleInFewNotchesAndCreepsOutAtFirst) {
  HandInput hand({});
  int notches = 0;
  for (; hand.X_WT().translation_mm.z < 12.0 && notches < 100; ++notches) {
    hand.setGap(0.2);  // its walls
    hand.take(render::WheelTurned{-1.0}, 0.25);
    if (notches == 2) {
      EXPECT_NEAR(hand.X_WT().translation_mm.z, 0.9, 1e-12) << "three small ones";
    }
  }
  EXPECT_LE(notches, 14);
  const double out_mm = hand.X_WT().translation_mm.z;
  hand.setGap(0.2);
  hand.take(render::WheelTurned{1.0}, 0.25);
  hand.setGap(0.2);
  hand.take(render::WheelTurned{-1.0}, 0.25);
  EXPECT_NEAR(hand.X_WT().translation_mm.z, out_mm - 0.1 + 0.3, 1e-9) << "a notch in ends the way out";
}

TEST(HandInput, MovesAsSeenInATurnedView) {
  HandInput hand({});
  const glm::dquat view = glm::angleAxis(0.5 * 3.14159265358979, glm::dvec3(0, 1, 0));
  hand.setView(view);
  hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::left}, 0.25);
  EXPECT_LT(glm::distance(view * hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, 0.0)), 1e-12);
  hand.setGap(2.5);
  hand.take(render::WheelTurned{1.0}, 0.25);
  EXPECT_LT(glm::distance(view * hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, -1.0)), 1e-12);
  const glm::dquat before = hand.X_WT().rotation;
  hand.take(KeyPressed{Key::up, true, false, false}, 0.25);
  const glm::dquat turned = view * hand.X_WT().rotation * glm::conjugate(before) * glm::conjugate(view);
  EXPECT_LT(glm::length(glm::cross(glm::axis(turned), glm::dvec3(1, 0, 0))), 1e-9) << "about the screen's axis";
}

TEST(HandInput, PlusMinusAndHomeChangeTheView) {
  HandInput hand({});
  for (const Key key : {render::keyOf('='), Key::keypad_add, render::keyOf('-'), Key::keypad_subtract, Key::home,
                        Key::page_up, Key::page_down})
    hand.take(KeyPressed{key, true, false, false}, 0.25);
  EXPECT_EQ(hand.takeRequests(), (std::vector<ControlRequest>{{Control::magnify},
                                                              {Control::magnify},
                                                              {Control::shrink},
                                                              {Control::shrink},
                                                              {Control::first_view},
                                                              {Control::slice_up},
                                                              {Control::slice_down}}));
}

TEST(HandInput, PedalIsHeldWithSpace) {
  HandInput hand({});
  hand.take(KeyPressed{Key::space, true, false, false}, 0.25);
  EXPECT_TRUE(hand.pedal());
  hand.take(KeyPressed{Key::space, false, false, false}, 0.25);
  EXPECT_FALSE(hand.pedal());
}

TEST(HandInput, KeysRotateAboutTheBur) {
  HandInput hand({{1, 0, 0, 0}, {1, 2, 3}});
  for (int i = 0; i < 30; ++i) hand.take(KeyPressed{render::keyOf('Q'), true, false, false}, 0.25);
  EXPECT_LT(glm::distance(hand.X_WT().rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-9);
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(1, 2, 3));
}

TEST(HandInput, AnElevatorIsTwistedAboutItsShaft) {
  const glm::dquat tilted = glm::angleAxis(0.6, glm::normalize(glm::dvec3(1, 1, 0)));
  HandInput hand({tilted, {1, 2, 3}});
  hand.setTwisting(true);
  for (int i = 0; i < 30; ++i) hand.take(KeyPressed{render::keyOf('E'), true, false, false}, 0.25);
  const glm::dquat turned = glm::conjugate(tilted) * hand.X_WT().rotation;
  EXPECT_LT(glm::distance(turned * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)), 1e-9);
  EXPECT_LT(glm::distance(turned * glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)), 1e-9) << "clockwise from the handle";
}

TEST(HandInput, RequestsComeOnceInTheOrderOfTheKeys) {
  HandInput hand({});
  EXPECT_TRUE(hand.takeRequests().empty());
  for (char letter : {'P', '3', 'D', 'X', 'R', 'T', 'U', 'I'})
    for (bool repeated : {false, true})
      hand.take(KeyPressed{render::keyOf(letter), true, repeated, letter == 'X'}, 0.25);
  hand.take(KeyPressed{render::keyOf('X'), true}, 0.25);
  hand.take(KeyPressed{Key::escape, true, false, false}, 0.25);
  hand.take(render::CloseRequested{}, 0.25);
  const std::vector<ControlRequest> wished = {
      {Control::snapshot}, {Control::law, 2}, {Control::drill},      {Control::stop}, {Control::arm},
      {Control::tool},     {Control::undo},   {Control::irrigation}, {Control::end},  {Control::end}};
  EXPECT_EQ(hand.takeRequests(), wished) << "X alone stops nothing";
  EXPECT_TRUE(hand.takeRequests().empty());
}

TEST(HandInput, KeysWithModifiersMeanWhatTheTableSays) {
  HandInput hand({});
  for (const auto& [letter, shift, control] :
       {std::tuple('U', true, false), std::tuple('Z', false, true), std::tuple('Z', true, true),
        std::tuple('Z', false, false), std::tuple('U', false, true), std::tuple('D', true, false)})
    hand.take(KeyPressed{render::keyOf(letter), true, false, shift, control}, 0.25);
  EXPECT_EQ(hand.takeRequests(), (std::vector<ControlRequest>{{Control::redo}, {Control::undo}, {Control::redo}}));
}

TEST(HandInput, TheWheelGoesAlongTheToolWhereItIsAskedTo) {
  calibration::Pose<calibration::World, calibration::Tool> X_WT;
  X_WT.rotation = glm::angleAxis(0.5 * calibration::kPi, glm::dvec3(1.0, 0.0, 0.0));
  HandInput hand(X_WT);
  hand.setGap(5.0);
  hand.setAlongTool(true);
  hand.take(render::WheelTurned{1.0}, 0.25);
  EXPECT_LT(glm::distance(hand.X_WT().translation_mm, glm::dvec3(0.0, 2.0, 0.0)), 1e-12) << "two fifths of the gap";
  hand.setAlongTool(false);
  hand.take(render::WheelTurned{1.0}, 0.25);
  EXPECT_LT(glm::distance(hand.X_WT().translation_mm, glm::dvec3(0.0, 2.0, -1.2)), 1e-12) << "into the picture";
}

}  // namespace
}  // namespace app
