#include "calibration/fit/pivot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "calibration/arm/phantom_models.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;

constexpr glm::dvec3 kBur_H_mm{1.5, -2.0, -57.0};

/// The bur's end in a pit, the handle swung to both sides by this much; the arm is computed from its angles.
std::vector<RawJoints> swung(double side_rad, double up_rad, int n = 20, double slip_mm = 0.0) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<RawJoints> holds;
  while (static_cast<int>(holds.size()) < n) {
    const glm::dquat rotation = glm::angleAxis(side_rad * unit(rng), glm::dvec3(0, 1, 0)) *
                                glm::angleAxis(up_rad * unit(rng), glm::dvec3(1, 0, 0));
    const glm::dvec3 pit = glm::dvec3(0.0, -60.0, -60.0) + slip_mm * glm::dvec3(unit(rng), unit(rng), unit(rng));
    const auto joints = jointsReaching(kOmniGeometry, {rotation, pit - rotation * kBur_H_mm});
    if (joints)
      holds.push_back({joints->arm_rad.x, joints->arm_rad.y, joints->arm_rad.z, joints->wrist_rad.x,
                       joints->wrist_rad.y, joints->wrist_rad.z});
  }
  return holds;
}

std::string refusal(const std::vector<RawJoints>& holds) {
  return tests::refusalOf<CalibrationError>([&] { fitPivot(kOmniGeometry, {}, holds); });
}

TEST(Pivot, FindsTheEndOfABur) {
  const Pivot pivot = fitPivot(kOmniGeometry, {}, swung(0.6, 0.5));
  EXPECT_LT(glm::distance(pivot.tip_H_mm, kBur_H_mm), 1e-6);
  EXPECT_LT(glm::distance(pivot.pit_D.mm, glm::dvec3(0.0, -60.0, -60.0)), 1e-6);
  EXPECT_LT(pivot.rms_mm, 1e-6);
  EXPECT_GT(pivot.tilt_spread_deg, 40.0);
}

TEST(Pivot, HasTheStatedUncertainty) {
  const Pivot pivot = fitPivot(kOmniGeometry, {}, swung(0.6, 0.5, 40, 0.2));
  EXPECT_GT(pivot.rms_mm, 0.1);
  EXPECT_LT(glm::distance(pivot.tip_H_mm, kBur_H_mm), 4.0 * pivot.sigma_mm);
  EXPECT_LT(pivot.sigma_mm, 0.15);
}

TEST(Pivot, IsRefusedWhereItIsUndetermined) {
  EXPECT_THAT(refusal(swung(0.6, 0.5, 11)), HasSubstr("too few"));
  EXPECT_THAT(refusal(swung(0.2, 0.2)), HasSubstr("swing it wider"));
  EXPECT_THAT(refusal(swung(0.7, 0.01)), HasSubstr("one plane only"));
  EXPECT_THAT(refusal(swung(0.6, 0.5, 20, 1.0)), HasSubstr("the tip moved"));
  auto holds = swung(0.6, 0.5);
  holds[3][5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(holds), HasSubstr("hold 4"));
}

}  // namespace
}  // namespace calibration
