#include "haptics/device/pedal/pedal_mapping.h"

#include <linux/input-event-codes.h>

#include <limits>

#include <gtest/gtest.h>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

TEST(PedalMapping, KnowsSwitchesByTheKernelsNames) {
  EXPECT_EQ(switchOf({"KEY_B", HandAction::undo}).code, KEY_B);
  EXPECT_EQ(switchOf({"BTN_THUMB2", HandAction::undo}).action, HandAction::undo);
  const PedalSwitch axis = switchOf({"-ABS_GAS", HandAction::drill, 0.3});
  EXPECT_TRUE(axis.is_axis);
  EXPECT_EQ(axis.code, ABS_GAS);
  EXPECT_EQ(axis.rest, AxisRest::high);
  EXPECT_EQ(axis.threshold, 0.3);
  EXPECT_EQ(axis.code, ABS_GAS);
}

TEST(PedalMapping, RefusesWhatIsNoSwitch) {
  for (const char* name : {"", "+", "B", "KEY_NOTHING", "+KEY_B", "REL_X", "abs_z"})
    EXPECT_THROW(switchOf({name, HandAction::drill}), DeviceError) << name;
  for (const double threshold : {0.0, 0.1, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(switchOf({"ABS_Z", HandAction::drill, threshold}), DeviceError) << threshold;
}

TEST(PedalMapping, LetsEveryLetterOfAFootSwitchDrill) {
  FoundPedal typing;
  typing.kind = InputKind::foot_switch;
  typing.traits.keys = {KEY_ESC, KEY_A, KEY_B};
  const auto switches = usualSwitches(typing);
  ASSERT_EQ(switches.size(), 3u);
  for (const PedalSwitch& one : switches) EXPECT_EQ(one.action, HandAction::drill);
}

TEST(PedalMapping, GivesOtherSwitchesTheActionsInOrder) {
  FoundPedal three;
  three.kind = InputKind::foot_switch;
  three.traits.keys = {BTN_0, BTN_1, BTN_2};
  three.traits.axes = {ABS_X, ABS_Y};
  const auto switches = usualSwitches(three);
  ASSERT_EQ(switches.size(), kHandActions) << "and no more than there are";
  for (std::size_t i = 0; i < switches.size(); ++i) EXPECT_EQ(switches[i].action, static_cast<HandAction>(i));
  EXPECT_EQ(switches[3].code, ABS_X);
}

TEST(PedalMapping, TakesOnlyPedalsOfAJoysticksAxes) {
  FoundPedal stick;
  stick.kind = InputKind::joystick;
  stick.traits.keys = {BTN_TRIGGER};
  stick.traits.axes = {ABS_X, ABS_Y, ABS_GAS, ABS_BRAKE};
  const auto switches = usualSwitches(stick);
  ASSERT_EQ(switches.size(), 3u);
  EXPECT_EQ(switches[1].code, ABS_GAS);
  EXPECT_EQ(switches[1].action, HandAction::drill);
  EXPECT_EQ(switches[2].action, HandAction::irrigation);
}

}  // namespace
}  // namespace haptics
