#include "haptics/device/usb/falcon_force_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

std::vector<ForceReading> readings(double gain) {
  std::vector<ForceReading> all;
  for (double asked_N : {0.25, 0.5, 0.75, 1.0}) all.push_back({asked_N, gain * asked_N});
  return all;
}

TEST(FalconForceScale, IsATenthOfTheMotorRangeUntilMeasured) {
  const FalconForceScale guess;
  EXPECT_FALSE(guess.isWeighed());
  EXPECT_EQ(falconMaxWord(guess), 409);
  EXPECT_DOUBLE_EQ(falconPeakForce_N(guess), 1.0);
  EXPECT_DOUBLE_EQ(falconPeakTorque_Nmm(guess), 40.9);
  EXPECT_THAT(falconForceAdvice(guess), testing::HasSubstr("weigh it"));
}

TEST(FalconForceScale, MeasuringMakesRequestedAndShownForceEqual) {
  // It showed 0.8 of what was asked, so every torque needs 1/0.8 of the words.
  const FalconForceScale scale = weighed({}, readings(0.8));
  EXPECT_NEAR(scale.words_per_Nmm, 12.5, 1e-12);
  EXPECT_DOUBLE_EQ(scale.max_weighed_N, 0.8);
  EXPECT_DOUBLE_EQ(falconPeakForce_N(scale), 2.4);
  EXPECT_EQ(falconForceAdvice(scale), "");
  // Weighed again with it, nothing changes.
  EXPECT_NEAR(weighed(scale, readings(1.0)).words_per_Nmm, 12.5, 1e-12);
}

TEST(FalconForceScale, NeverAllowsMoreThanItsMakerDoes) {
  FalconForceScale scale;
  scale.max_weighed_N = 5.0;
  EXPECT_DOUBLE_EQ(falconPeakForce_N(scale), 8.0);
}

TEST(FalconForceScale, RefusesInconsistentReadings) {
  EXPECT_THROW(weighed({}, std::vector<ForceReading>{{0.5, 0.5}, {1.0, 1.0}}), DeviceError);
  EXPECT_THROW(weighed({}, readings(-1.0)), DeviceError);
  EXPECT_THROW(weighed({}, readings(0.0)), DeviceError);
  EXPECT_THROW(weighed({}, readings(30.0)), DeviceError);
  EXPECT_THROW(weighed({}, readings(std::nan(""))), DeviceError);
  auto bent = readings(1.0);
  bent[1].shown_N += 0.3;
  EXPECT_THROW(weighed({}, bent), DeviceError);
  EXPECT_NO_THROW(weighed({}, readings(0.7)));
}

TEST(FalconForceScale, RefusesImplausibleValues) {
  for (double words : {0.0, 1.9, 51.0, -10.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(check({words, 1.0, ""}), DeviceError) << words;
  for (double heaviest : {-1.0, 0.1, 11.0, double(NAN)})
    EXPECT_THROW(check({10.0, heaviest, ""}), DeviceError) << heaviest;
  EXPECT_NO_THROW(check({}));
  EXPECT_NO_THROW(check({10.0, 1.0, ""}));
}

}  // namespace
}  // namespace haptics
