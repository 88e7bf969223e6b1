#include "haptics/device/simulated/fixed_device.h"

#include <gtest/gtest.h>

#include <limits>

namespace haptics {
namespace {

TEST(FixedDevice, StaysWhereItIsWhateverPushesIt) {
  const calibration::Pose<calibration::Device, calibration::Handle> place{
      glm::angleAxis(0.5, glm::normalize(glm::dvec3(1, 2, 3))), {4, 5, 6}};
  FixedDevice hand(place);
  for (int tick = 0; tick < 100; ++tick) {
    const HandleState state = hand.exchange({{{3.0, -3.0, 3.0}}, {{100.0, 0.0, 0.0}}}, 1e-3);
    EXPECT_EQ(state.X_DH.translation_mm, place.translation_mm);
    EXPECT_EQ(state.X_DH.rotation, place.rotation);
    EXPECT_EQ(state.velocity_D_mm_per_s.xyz, glm::dvec3(0.0));
    EXPECT_FALSE(state.pedal);
  }
}

TEST(FixedDevice, RefusesAPlaceThatIsNone) {
  EXPECT_THROW(FixedDevice({{2.0, 0.0, 0.0, 0.0}, {0, 0, 0}}), DeviceError);
  EXPECT_THROW(FixedDevice({{1.0, 0.0, 0.0, 0.0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}}), DeviceError);
}

}  // namespace
}  // namespace haptics
