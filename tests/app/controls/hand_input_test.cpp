#include "app/controls/hand_input.h"

#include <gtest/gtest.h>

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

TEST(HandInput, WheelMovesInDepth) {
  HandInput hand({});
  hand.take(render::WheelTurned{2.0}, 0.25);
  EXPECT_EQ(hand.X_WT().translation_mm.z, -1.0);
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

}  // namespace
}  // namespace app
