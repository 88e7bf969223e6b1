#include "haptics/device/usb/wooden_homing.h"

#include <gtest/gtest.h>

namespace haptics {
namespace {

constexpr std::array<std::int16_t, 6> kHome{0, 0, 6000, 0, 0, 0};

void takeFive(WoodenHoming& homing, const WoodenReading& reading, bool motors_on) {
  for (int i = 0; i < 5; ++i) homing.take(reading, motors_on);
}

WoodenReading reads(std::array<std::int16_t, 6> encoders, bool pressed) { return {encoders, false, pressed}; }

TEST(WoodenHoming, IsHomeOnceThePresetIsReadBack) {
  WoodenHoming homing(kHome, true);
  homing.take(reads({5, 6, 7, 0, 0, 0}, false), false);
  EXPECT_FALSE(homing.isHome() || homing.wantsPreset());
  takeFive(homing, reads({5, 6, 7, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.wantsPreset());
  homing.take(reads({5, 6, 7, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.wantsPreset());
  homing.take(reads({0, 1, 5990, 0, 0, 0}, false), false);
  EXPECT_TRUE(homing.isHome());
  EXPECT_FALSE(homing.wantsPreset());
}

TEST(WoodenHoming, APressBeforeTheStartIsCleared) {
  WoodenHoming homing(kHome, true);
  homing.take(reads({5, 6, 7, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.wantsPreset());
  homing.take(reads({0, 0, 6000, 0, 0, 0}, false), false);
  EXPECT_FALSE(homing.isHome() || homing.wantsPreset());
  takeFive(homing, reads({10, 0, 6100, 0, 0, 0}, true), false);
  homing.take(reads({0, 0, 6000, 0, 0, 0}, false), false);
  EXPECT_TRUE(homing.isHome());
}

TEST(WoodenHoming, NothingIsPresetWhileTheMotorsAreOn) {
  WoodenHoming homing(kHome, true);
  homing.ask();
  homing.take(reads(kHome, false), false);
  homing.take(reads(kHome, false), false);
  ASSERT_TRUE(homing.isHome());
  // Pressed in mid-stroke, it says nothing of where the arm is when the motors go off.
  homing.take(reads({300, 0, 0, 0, 0, 0}, true), true);
  homing.take(reads({400, 0, 0, 0, 0, 0}, true), true);
  takeFive(homing, reads({500, 0, 0, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.isHome());
  homing.ask();
  homing.take(reads({500, 0, 0, 0, 0, 0}, true), true);
  homing.take(reads({500, 0, 0, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.isHome());
  homing.ask();
  homing.take(reads({500, 0, 0, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.wantsPreset());
  EXPECT_FALSE(homing.isHome());
}

TEST(WoodenHoming, AFlickerOfTheSwitchIsNoPress) {
  WoodenHoming homing(kHome, true);
  homing.take(reads({0, 0, 0, 0, 0, 0}, false), false);
  homing.ask();
  homing.take(reads({0, 0, 0, 0, 0, 0}, false), false);
  homing.take(reads(kHome, false), false);
  ASSERT_TRUE(homing.isHome());
  for (int i = 0; i < 1000; ++i) homing.take(reads({300, 0, 0, 0, 0, 0}, i % 5 != 0), false);
  EXPECT_TRUE(homing.isHome());
  takeFive(homing, reads({300, 0, 0, 0, 0, 0}, true), false);
  EXPECT_TRUE(homing.wantsPreset());
}

TEST(WoodenHoming, LooksAtAGimbalOnlyWhereThereIsOne) {
  for (bool has_gimbal : {false, true}) {
    WoodenHoming homing(kHome, has_gimbal);
    homing.ask();
    homing.take(reads({0, 0, 0, 0, 0, 0}, false), false);
    homing.take(reads({0, 0, 6000, 0, 0, 5000}, false), false);
    EXPECT_EQ(homing.isHome(), !has_gimbal);
  }
}

TEST(WoodenHoming, RepeatsThePresetUntilTheEncodersReadBack) {
  WoodenHoming homing(kHome, true);
  homing.ask();
  for (int i = 0; i < 1000; ++i) {
    homing.take(reads({0, 0, 0, 0, 0, 0}, false), false);
    ASSERT_TRUE(homing.wantsPreset());
    ASSERT_FALSE(homing.isHome());
  }
}

}  // namespace
}  // namespace haptics
