#include "haptics/device/pedal/hand_action.h"

#include <gtest/gtest.h>

namespace haptics {
namespace {

TEST(HandAction, HasNamesThatParseBack) {
  for (std::size_t i = 0; i < kHandActions; ++i) {
    const auto action = static_cast<HandAction>(i);
    EXPECT_EQ(handActionNamed(nameOf(action)), action);
  }
  EXPECT_FALSE(handActionNamed("Drill"));
  EXPECT_FALSE(handActionNamed(""));
}

TEST(ButtonMeanings, MakeEveryCombinationOfButtonsTheUnionOfTheirActions) {
  ButtonMeanings meanings;
  meanings.of_bit = {HandAction::undo, std::nullopt, HandAction::drill, HandAction::undo};
  for (std::uint32_t buttons = 0; buttons < 32; ++buttons) {
    const HandActions held = meanings.actionsOf(buttons);
    EXPECT_EQ(held.has(HandAction::undo), (buttons & 0b1001u) != 0) << buttons;
    EXPECT_EQ(held.has(HandAction::drill), (buttons & 0b100u) != 0) << buttons;
    EXPECT_FALSE(held.has(HandAction::irrigation) || held.has(HandAction::tool_change)) << buttons;
  }
  meanings.of_bit[31] = HandAction::irrigation;
  EXPECT_TRUE(meanings.actionsOf(1u << 31).has(HandAction::irrigation));
}

TEST(PressCount, CountsBeginningsNotCalls) {
  PressCount count;
  const HandActions drill = HandActions{}.with(HandAction::drill), both = drill.with(HandAction::undo);
  EXPECT_EQ(count.look(drill), drill);
  EXPECT_EQ(count.look(drill), HandActions{});
  EXPECT_EQ(count.look(both), HandActions{}.with(HandAction::undo));
  EXPECT_EQ(count.look({}), HandActions{});
  EXPECT_EQ(count.look(both), both);
  EXPECT_EQ(count.of(HandAction::drill), 2u);
  EXPECT_EQ(count.of(HandAction::undo), 2u);
  EXPECT_EQ(count.of(HandAction::irrigation), 0u);
}

}  // namespace
}  // namespace haptics
