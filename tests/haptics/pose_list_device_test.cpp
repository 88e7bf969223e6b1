#include "haptics/device/simulated/pose_list_device.h"

#include <gtest/gtest.h>

#include <limits>

namespace haptics {
namespace {

using Pose = calibration::Pose<calibration::Device, calibration::Handle>;

constexpr double kTick_s = 1e-3;

TimedHandlePose hold(double t_s, const glm::dvec3& position_mm, bool pedal = false, double turned_rad = 0.0) {
  return {t_s, Pose{glm::angleAxis(turned_rad, glm::dvec3(0, 0, 1)), position_mm}, pedal};
}

/// Its state at tick `index`.
HandleState at(PoseListDevice& hand, int& done, int index) {
  HandleState state;
  for (; done <= index; ++done) state = hand.exchange({{{5.0, 5.0, 5.0}}, {}}, kTick_s);
  return state;
}

TEST(PoseListDevice, IsExactlyAtEachPoseAtItsTickWhateverPushesIt) {
  std::vector<TimedHandlePose> holds;
  for (int n = 0; n < 40; ++n)
    holds.push_back(hold(70.0 * n / 1000.0, {0.1 * n, -0.3 * n * n, 1.0 / (n + 1)}, n % 2 == 1, 0.05 * n));
  PoseListDevice hand(holds);
  int done = 0;
  for (int n = 0; n < 40; ++n) {
    const HandleState state = at(hand, done, 70 * n);
    EXPECT_LT(glm::distance(state.X_DH.translation_mm, holds[static_cast<std::size_t>(n)].X_DH.translation_mm), 1e-12);
    EXPECT_EQ(state.pedal, n % 2 == 1 && n < 39) << n;
  }
  EXPECT_DOUBLE_EQ(hand.duration_s(), 2.73);
}

TEST(PoseListDevice, InterpolatesLinearlyBetweenTwoPoses) {
  PoseListDevice hand({hold(0.0, {0, 0, 0}), hold(1.0, {8, 4, -2}, false, 1.2)});
  int done = 0;
  const HandleState state = at(hand, done, 250);
  EXPECT_LT(glm::distance(state.X_DH.translation_mm, glm::dvec3(2.0, 1.0, -0.5)), 1e-12);
  EXPECT_NEAR(glm::angle(state.X_DH.rotation), 0.3, 1e-12);
  EXPECT_LT(glm::distance(state.velocity_D_mm_per_s.xyz, glm::dvec3(8.0, 4.0, -2.0)), 1e-9);
}

TEST(PoseListDevice, HoldsTheFirstAndTheLastPoseWithThePedalUp) {
  PoseListDevice hand({hold(0.5, {1, 2, 3}, true), hold(0.6, {1, 2, 4}, true)});
  int done = 0;
  HandleState state = at(hand, done, 499);
  EXPECT_EQ(state.X_DH.translation_mm, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(state.pedal);
  EXPECT_EQ(state.velocity_D_mm_per_s.xyz, glm::dvec3(0.0));
  EXPECT_TRUE(at(hand, done, 500).pedal);
  EXPECT_TRUE(at(hand, done, 599).pedal);
  state = at(hand, done, 5000);
  EXPECT_EQ(state.X_DH.translation_mm, glm::dvec3(1, 2, 4));
  EXPECT_FALSE(state.pedal);
  EXPECT_EQ(state.velocity_D_mm_per_s.xyz, glm::dvec3(0.0));
}

TEST(PoseListDevice, RefusesInvalidPoses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PoseListDevice({}), DeviceError);
  EXPECT_THROW(PoseListDevice({hold(-0.1, {0, 0, 0})}), DeviceError);
  EXPECT_THROW(PoseListDevice({hold(nan, {0, 0, 0})}), DeviceError);
  EXPECT_THROW(PoseListDevice({hold(0.1, {0, 0, 0}), hold(0.1, {0, 0, 1})}), DeviceError);
  EXPECT_THROW(PoseListDevice({hold(0.1, {0, nan, 0})}), DeviceError);
  EXPECT_THROW(PoseListDevice({{0.0, Pose{{2.0, 0.0, 0.0, 0.0}, {0, 0, 0}}, false}}), DeviceError);
}

}  // namespace
}  // namespace haptics
