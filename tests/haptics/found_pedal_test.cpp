#include "haptics/device/pedal/found_pedal.h"

#include <linux/input-event-codes.h>

#include <random>

#include <gtest/gtest.h>

#include "tests/haptics/fake_input_device.h"

namespace haptics {
namespace {

std::vector<std::uint16_t> allLetters() {
  std::vector<std::uint16_t> keys;
  for (std::uint16_t code = KEY_ESC; code <= KEY_F10; ++code) keys.push_back(code);
  return keys;
}

InputKind kindOfFake(const FakeTraits& traits) {
  const FakeInputFolder folder("kind");
  const FakeInputDevice device(folder, 0, traits);
  const auto found = inputDevices(folder.folders().classes);
  return found.size() == 1 ? kindOf(found[0]) : InputKind::other;
}

TEST(FoundPedal, IsAFootSwitchByNameOrByIdentity) {
  EXPECT_EQ(kindOfFake({"PCsensor FootSwitch", allLetters()}), InputKind::foot_switch);
  EXPECT_EQ(kindOfFake({"CH Pro PEDALS", {}, {ABS_X, ABS_Y}}), InputKind::foot_switch);
  EXPECT_EQ(kindOfFake({"HID 0c45:7404", allLetters(), {}, {}, 0x0c45, 0x7404}), InputKind::foot_switch);
}

TEST(FoundPedal, IsNeverAKeyboardAMouseOrAPad) {
  EXPECT_EQ(kindOfFake({"AT Translated Set 2 keyboard", allLetters()}), InputKind::keyboard);
  EXPECT_EQ(kindOfFake({"Foot mouse", {BTN_LEFT, BTN_JOYSTICK}, {}, {REL_X, REL_Y}}), InputKind::other);
  EXPECT_EQ(kindOfFake({"Touchpad", {BTN_TOUCH, BTN_JOYSTICK}, {ABS_X, ABS_Y}}), InputKind::other);
  EXPECT_EQ(kindOfFake({"Power Button", {KEY_POWER}}), InputKind::other);
  EXPECT_EQ(kindOfFake({"Footless"}), InputKind::other) << "nothing to press";
}

TEST(FoundPedal, ListsFootSwitchesBeforeJoysticksAndNothingElse) {
  const FakeInputFolder folder("list");
  const FakeInputDevice stick(folder, 2, {"Stick", {BTN_TRIGGER}}), keyboard(folder, 3, {"Keyboard", allLetters()}),
      pedal(folder, 10, {"Foot pedal", {BTN_0}});
  const auto found = findPedals(folder.folders());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].path, pedal.path());
  EXPECT_EQ(found[1].path, stick.path());
  EXPECT_TRUE(found[0].may_be_read);
  EXPECT_FALSE(pedal.wasOpened() || keyboard.wasOpened()) << "looking opens nothing";
}

TEST(FoundPedal, IsWhatItsOwnerNames) {
  const FakeInputFolder folder("named");
  const FakeInputDevice keyboard(folder, 1, {"Old Keyboard", allLetters()}), stick(folder, 2, {"Stick", {BTN_TRIGGER}});
  EXPECT_EQ(pedalsMeant("auto", folder.folders()).size(), 1u);
  const auto named = pedalsMeant("old key", folder.folders());
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].path, keyboard.path());
  EXPECT_FALSE(named[0].sendsLetters()) << "a keyboard is read beside others";
  EXPECT_EQ(pedalsMeant(stick.path(), folder.folders()).size(), 1u);
  EXPECT_TRUE(pedalsMeant("drum", folder.folders()).empty());
}

TEST(FoundPedal, IsNotFoundWithoutInputDevices) { EXPECT_TRUE(findPedals({"/nowhere/class", "/nowhere/dev"}).empty()); }

TEST(InputTraits, ReadBitMapsAsTheKernelWritesThem) {
  EXPECT_EQ(bitsInText("3"), (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(bitsInText("1 0 8000000000000000"), (std::vector<std::uint16_t>{63, 128}));
  EXPECT_TRUE(bitsInText("").empty());
  EXPECT_TRUE(bitsInText("0").empty());
}

TEST(InputTraits, SurviveAnyText) {
  std::mt19937 random(1);
  for (int run = 0; run < 2000; ++run) {
    std::string text(std::uniform_int_distribution<std::size_t>(0, 300)(random), ' ');
    for (char& c : text) c = " 0123456789abcdefxzFG-\t\xff"[std::uniform_int_distribution(0, 23)(random)];
    for (const std::uint16_t bit : bitsInText(text)) ASSERT_LT(bit, 16 * 64);
  }
}

}  // namespace
}  // namespace haptics
