#include "app/controls/other_hand_input.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using render::Key;
using render::KeyPressed;

constexpr KeyPressed kHold{render::keyOf('O'), true, false, false}, kLetGo{render::keyOf('O'), false, false, false};
const render::WindowEvent kDrag = render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::left};

TEST(OtherHandInput, MovesOnlyWhileItsKeyIsHeld) {
  OtherHandInput hand({{1, 0, 0, 0}, {5, 0, 0}}, false);
  EXPECT_FALSE(hand.take(kDrag, 0.25)) << "the first hand's";
  EXPECT_EQ(hand.X_WO().translation_mm, glm::dvec3(5, 0, 0));
  EXPECT_TRUE(hand.take(kHold, 0.25));
  EXPECT_TRUE(hand.take(kDrag, 0.25));
  EXPECT_EQ(hand.X_WO().translation_mm, glm::dvec3(7, -1, 0));
  EXPECT_TRUE(hand.take(render::WheelTurned{1.0}, 0.25));
  EXPECT_NEAR(hand.X_WO().translation_mm.z, -2.0, 1e-12);
  EXPECT_TRUE(hand.take(KeyPressed{Key::up, true, false, false}, 0.25));
  EXPECT_NE(hand.X_WO().rotation, glm::dquat(1, 0, 0, 0));
  hand.take(kLetGo, 0.25);
  const auto rests = hand.X_WO();
  EXPECT_FALSE(hand.take(kDrag, 0.25));
  EXPECT_FALSE(hand.take(KeyPressed{Key::up, true, false, false}, 0.25));
  EXPECT_EQ(hand.X_WO().translation_mm, rests.translation_mm);
  EXPECT_EQ(hand.X_WO().rotation, rests.rotation);
}

TEST(OtherHandInput, LeavesPedalAndControlsToTheFirstHand) {
  for (const bool has_mouse : {false, true}) {
    OtherHandInput hand({}, has_mouse);
    hand.take(kHold, 0.25);
    for (const Key key : {Key::space, Key::escape, render::keyOf('T'), render::keyOf('I'), Key::left_shift})
      EXPECT_FALSE(hand.take(KeyPressed{key, true, false, false}, 0.25));
    EXPECT_FALSE(hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::right}, 0.25)) << "turns the view";
    EXPECT_FALSE(hand.take(render::CloseRequested{}, 0.25));
  }
}

TEST(OtherHandInput, HasTheMouseAloneWhereAnotherDeviceMovesTheFirst) {
  OtherHandInput hand({}, true);
  EXPECT_TRUE(hand.take(kDrag, 0.25));
  EXPECT_EQ(hand.X_WO().translation_mm, glm::dvec3(2, -1, 0));
  // With Shift, pressed before, the wheel goes five times as far.
  hand.take(KeyPressed{Key::left_shift, true, false, true}, 0.25);
  hand.take(render::WheelTurned{1.0}, 0.25);
  EXPECT_NEAR(hand.X_WO().translation_mm.z, -10.0, 1e-12);
}

}  // namespace
}  // namespace app
