#include "app/hand_input.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using render::Key;
using render::KeyPressed;

TEST(HandInput, DragsInThePlaneOfTheScreenOneToOne) {
  HandInput hand({}, 0.25);
  hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::left});
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, 0.0));
  hand.take(render::PointerMoved{{0, 0}, {8, 4}, render::MouseButton::none});
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(2.0, -1.0, 0.0)) << "moving is not dragging";
}

TEST(HandInput, WheelGoesAway) {
  HandInput hand({}, 0.25);
  hand.take(render::WheelTurned{2.0});
  EXPECT_EQ(hand.X_WT().translation_mm.z, -1.0);
}

TEST(HandInput, PedalIsHeldWithSpace) {
  HandInput hand({}, 0.25);
  hand.take(KeyPressed{Key::space, true, false, false});
  EXPECT_TRUE(hand.pedal());
  hand.take(KeyPressed{Key::space, false, false, false});
  EXPECT_FALSE(hand.pedal());
}

TEST(HandInput, KeysTurnAboutTheBur) {
  HandInput hand({{1, 0, 0, 0}, {1, 2, 3}}, 0.25);
  for (int i = 0; i < 30; ++i) hand.take(KeyPressed{render::keyOf('Q'), true, false, false});
  EXPECT_LT(glm::distance(hand.X_WT().rotation * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-9);
  EXPECT_EQ(hand.X_WT().translation_mm, glm::dvec3(1, 2, 3));
}

TEST(HandInput, AsksForEndAndSnapshots) {
  HandInput hand({}, 0.25);
  hand.take(KeyPressed{render::keyOf('P'), true, false, false});
  EXPECT_TRUE(hand.takeSnapshotAsked());
  EXPECT_FALSE(hand.takeSnapshotAsked());
  EXPECT_FALSE(hand.endAsked());
  hand.take(render::CloseAsked{});
  EXPECT_TRUE(hand.endAsked());
}

}  // namespace
}  // namespace app
