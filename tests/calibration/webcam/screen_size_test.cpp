#include "calibration/webcam/screen_size.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

const ScreenCorners kBelieved = desktopRig({1920, 1080}, 500.0).screen;

std::string refusal(const MeasuredBars& bars) {
  return tests::refusalOf<CalibrationError>([&] { checkedSize(kBelieved, bars); });
}

TEST(ScreenSize, KeepsAScreenWithinARulersAccuracy) {
  const SizeCheck check = checkedSize(kBelieved, {100.0, 100.2, 99.8});
  EXPECT_TRUE(check.agrees);
  EXPECT_EQ(check.corners.lower_left.mm, kBelieved.lower_left.mm);
}

TEST(ScreenSize, ScalesTheScreenByTheBars) {
  const SizeCheck check = checkedSize(kBelieved, {100.0, 103.0, 102.0});
  EXPECT_FALSE(check.agrees);
  const glm::dvec3 right = check.corners.lower_right.mm - check.corners.lower_left.mm;
  const glm::dvec3 up = check.corners.upper_left.mm - check.corners.lower_left.mm;
  EXPECT_NEAR(glm::length(right), 515.0, 1e-9);
  EXPECT_NEAR(glm::length(up), 1.02 * 281.25, 1e-9);
  EXPECT_NEAR(glm::length(check.corners.lower_left.mm + 0.5 * (right + up)), 0.0, 1e-9) << "its middle stays";
  EXPECT_THAT(check.line, HasSubstr("+3.0 %"));
}

TEST(ScreenSize, RefusesInvalidMeasurements) {
  EXPECT_THAT(refusal({100.0, 10.2, 10.2}), HasSubstr("20 %"));
  EXPECT_THAT(refusal({100.0, 105.0, 100.0}), HasSubstr("stretched"));
  EXPECT_THAT(refusal({20.0, 20.0, 20.0}), HasSubstr("50 mm"));
  EXPECT_THAT(refusal({100.0, std::nan(""), 100.0}), HasSubstr("not finite"));
}

}  // namespace
}  // namespace calibration
