#include "haptics/device/pedal/foot_pedal.h"

#include <linux/input-event-codes.h>
#include <sys/resource.h>

#include <chrono>
#include <memory>

#include <gtest/gtest.h>

#include "haptics/device/haptic_device.h"
#include "tests/haptics/fake_input_device.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// As long as it takes on a busy machine.
template <class Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 10'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

const FakeTraits kThreeSwitches{"Foot pedal", {BTN_0, BTN_1, BTN_2}, {ABS_GAS}};

TEST(FootPedal, HoldsActionsAndCountsPresses) {
  const FakeInputFolder folder("holds");
  FakeInputDevice device(folder, 4, kThreeSwitches);
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  EXPECT_EQ(pedal.described(), "Foot pedal, " + device.path());
  EXPECT_FALSE(device.isGrabbed());
  device.send(EV_KEY, BTN_0, 1);
  EXPECT_TRUE(eventually([&] { return pedal.held().has(HandAction::drill); }));
  device.send(EV_KEY, BTN_2, 1);
  device.send(EV_KEY, BTN_2, 0);
  device.send(EV_KEY, BTN_0, 0);
  EXPECT_TRUE(eventually([&] { return pedal.held() == HandActions{}; }));
  EXPECT_EQ(pedal.presses(HandAction::drill), 1u);
}

TEST(FootPedal, LetsGoWhenUnpluggedAndWorksAgainWhenPluggedIn) {
  const FakeInputFolder folder("unplug");
  auto device = std::make_unique<FakeInputDevice>(folder, 4, kThreeSwitches);
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  device->send(EV_KEY, BTN_0, 1);
  ASSERT_TRUE(eventually([&] { return pedal.held().has(HandAction::drill); }));
  device->unplug();
  EXPECT_TRUE(eventually([&] { return !pedal.isThere(); }));
  EXPECT_EQ(pedal.held(), HandActions{});
  EXPECT_EQ(pedal.described(), "the pedal was unplugged");

  device = std::make_unique<FakeInputDevice>(folder, 5, kThreeSwitches);
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  device->send(EV_KEY, BTN_0, 1);
  EXPECT_TRUE(eventually([&] { return pedal.presses(HandAction::drill) == 2; }));
}

TEST(FootPedal, CountsNoPedalThatWasDownWhenItWasFound) {
  const FakeInputFolder folder("down");
  FakeTraits traits = kThreeSwitches;
  traits.down = {BTN_0};
  FakeInputDevice device(folder, 0, traits);
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  device.send(EV_KEY, BTN_0, 2);  // the kernel repeats a key that is held
  device.send(EV_KEY, BTN_1, 1);
  EXPECT_TRUE(eventually([&] { return pedal.held().has(HandAction::irrigation); }));
  EXPECT_FALSE(pedal.held().has(HandAction::drill));
}

TEST(FootPedal, GrabsAFootSwitchThatTypes) {
  const FakeInputFolder folder("grab");
  FakeInputDevice typing(folder, 1, {"FootSwitch", {KEY_A, KEY_B}});
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  EXPECT_TRUE(typing.isGrabbed());
}

TEST(FootPedal, NeverGrabsAKeyboardEvenWhenNamed) {
  const FakeInputFolder folder("keyboard");
  std::vector<std::uint16_t> keys;
  for (std::uint16_t code = KEY_ESC; code <= KEY_F10; ++code) keys.push_back(code);
  FakeInputDevice keyboard(folder, 1, {"Keyboard", keys});
  const FootPedal pedal({"Keyboard", {{"KEY_F1", HandAction::undo}}}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  EXPECT_FALSE(keyboard.isGrabbed());
  keyboard.send(EV_KEY, KEY_B, 1);
  keyboard.send(EV_KEY, KEY_F1, 1);
  EXPECT_TRUE(eventually([&] { return pedal.held() == HandActions{}.with(HandAction::undo); }));
}

TEST(FootPedal, ReadsAnAxisAsAPedal) {
  const FakeInputFolder folder("axis");
  FakeInputDevice device(folder, 1, kThreeSwitches);
  const FootPedal pedal({"auto", {{"ABS_GAS", HandAction::irrigation, 0.8}}}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  for (const int value : {250, 100, 60}) device.send(EV_ABS, ABS_GAS, value);
  device.send(EV_ABS, ABS_GAS, 20);
  EXPECT_TRUE(eventually([&] { return pedal.held().has(HandAction::irrigation); }));
  device.send(EV_ABS, ABS_GAS, 200);
  EXPECT_TRUE(eventually([&] { return pedal.held() == HandActions{}; }));
}

TEST(FootPedal, ReleasesADeviceThatSendsGarbage) {
  const FakeInputFolder folder("garbage");
  FakeInputDevice device(folder, 1, kThreeSwitches);
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  device.send(EV_KEY, BTN_0, 1);
  ASSERT_TRUE(eventually([&] { return pedal.held().has(HandAction::drill); }));
  device.sendBytes("no event");
  EXPECT_TRUE(eventually([&] { return pedal.held() == HandActions{}; }));
}

TEST(FootPedal, ReleasesEverythingWhenPollFails) {
  const FakeInputFolder folder("poll");
  FakeInputDevice device(folder, 1, kThreeSwitches);
  const FootPedal pedal({}, folder.folders());
  ASSERT_TRUE(eventually([&] { return pedal.isThere(); }));
  // poll(2) fails with EINVAL for more handles than a process may have.
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit one{1, limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &one), 0);
  device.send(EV_KEY, BTN_0, 1);
  EXPECT_TRUE(eventually([&] { return pedal.presses(HandAction::drill) == 1 && !pedal.isThere(); }));
  EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(pedal.held(), HandActions{});
  EXPECT_NE(pedal.described().find("read no more"), std::string::npos);
}

TEST(FootPedal, ReportsWhyThereIsNone) {
  const FakeInputFolder folder("none");
  const FootPedal nobody({}, folder.folders());
  EXPECT_EQ(nobody.described(), "no pedal found yet");
  const FakeInputDevice device(folder, 1, kThreeSwitches);
  const FootPedal elsewhere({"auto", {{"KEY_F9", HandAction::undo}}}, folder.folders());
  EXPECT_TRUE(eventually([&] { return elsewhere.described().ends_with("none of the switches that are mapped"); }));
  EXPECT_FALSE(elsewhere.isThere());
  EXPECT_THROW(FootPedal({"auto", {{"PEDAL", HandAction::undo}}}, folder.folders()), DeviceError);
}

}  // namespace
}  // namespace haptics
