#include "calibration/fit/rezero.h"

#include <gtest/gtest.h>

#include <limits>

#include "calibration/geometry/units.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace calibration {
namespace {

constexpr glm::dvec3 kRegion_mm{70.0, 50.0, 35.0};

/// As if calibration had found every correctable error.
MeasuredArm perfectly(const SyntheticRig& rig) { return {rig.arm.geometry, rig.arm.truth, rig.X_WD}; }

double tre_mm(const MeasuredArm& arm, const SyntheticRig& rig, std::uint32_t seed) {
  std::mt19937 rng(seed);
  double sum = 0.0;
  const std::vector<Touch> judges = heldOutTouches(rig, 100, kRegion_mm, rng);
  for (const Touch& touch : judges) sum += std::pow(glm::length((arm.tip_W(touch.joints_rad) - touch.target_W).xyz), 2);
  return std::sqrt(sum / static_cast<double>(judges.size()));
}

/// No noise, no outliers, no uncorrectable errors.
SyntheticRig exact(std::uint32_t seed) {
  SyntheticRig rig = syntheticRig(Scenario::b, seed);
  rig.arm.ripple = {};
  rig.technician.precision = {0.0, 0.0};
  rig.technician.arm_noise_rad = rig.technician.gimbal_noise_rad = rig.technician.outlier_share = 0.0;
  return rig;
}

TouchSet fiveTouches(const SyntheticRig& rig, std::uint32_t seed) {
  std::mt19937 rng(seed);
  return simulatedTouches(rig, targetPlan("rezero5").value(), rng);
}

SyntheticRig nightLater(const SyntheticRig& rig, std::uint32_t seed) {
  std::mt19937 rng(seed);
  return drifted(rig, 0.3, 1.0, rng);
}

TEST(Rezero, KeepsAnArmThatHasNotMoved) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const SyntheticRig rig = exact(seed);
    const Rezero result = rezeroed(perfectly(rig), fiveTouches(rig, seed));
    EXPECT_LT(result.before_rms_mm, 1e-5);
    EXPECT_LT(result.moved_mm, 1e-3);
    EXPECT_LT(result.turned_deg, 1e-3);
    EXPECT_EQ(result.outliers, 0);
  }
}

TEST(Rezero, FindsAPushedBase) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const SyntheticRig rig = exact(seed);
    SyntheticRig pushed = rig;
    const glm::dquat rotation = glm::angleAxis(radFromDegrees(3.0), glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    pushed.X_WD = {rotation * rig.X_WD.rotation, rig.X_WD.translation_mm + glm::dvec3(8.0, -3.0, 2.0)};
    const Rezero result = rezeroed(perfectly(rig), fiveTouches(pushed, seed));
    EXPECT_GT(result.before_rms_mm, 5.0);
    EXPECT_LT(result.after_rms_mm, 0.02);
    EXPECT_LT(tre_mm(result.arm, pushed, seed), 0.03);
    EXPECT_NEAR(result.turned_deg, 3.0, 0.2);
  }
}

TEST(Rezero, FindsNewJointOffsets) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const SyntheticRig rig = exact(seed);
    SyntheticRig homed = rig;
    homed.arm.truth.offset_rad[1] += radFromDegrees(0.6);
    homed.arm.truth.offset_rad[2] -= radFromDegrees(0.4);
    const Rezero result = rezeroed(perfectly(rig), fiveTouches(homed, seed));
    EXPECT_LT(tre_mm(result.arm, homed, seed), 0.03);
    EXPECT_NEAR(result.offset_change_deg[1], 0.6, 0.1);
    EXPECT_NEAR(result.offset_change_deg[2], -0.4, 0.1);
    EXPECT_EQ(result.arm.correction.gain, rig.arm.truth.gain) << "the rest stays";
    EXPECT_EQ(result.arm.correction.tip_H_mm, rig.arm.truth.tip_H_mm);
  }
}

TEST(Rezero, RestoresATypicalArmAfterOvernightDrift) {
  std::vector<double> before, after;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const SyntheticRig rig = syntheticRig(Scenario::d, seed), now = nightLater(rig, seed);
    const Rezero result = rezeroed(perfectly(rig), fiveTouches(now, seed));
    before.push_back(tre_mm(perfectly(rig), now, seed));
    after.push_back(tre_mm(result.arm, now, seed));
  }
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_GT(before[30], 1.5);
  EXPECT_LT(after[57], 0.42) << "95 of 100";
}

TEST(Rezero, NamesAnOutlier) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    SyntheticRig rig = syntheticRig(Scenario::d, seed);
    rig.technician.outlier_share = 0.0;
    const SyntheticRig now = nightLater(rig, seed);
    TouchSet set = fiveTouches(now, seed);
    const Rezero clean = rezeroed(perfectly(rig), set);
    EXPECT_EQ(clean.outliers, 0) << seed;

    const std::size_t slipped = seed % 5;
    std::mt19937 rng(seed);
    const glm::dvec3 way = glm::normalize(glm::dvec3(static_cast<double>(rng() % 9) - 4.0, 1.0, 2.5));
    set.touches[slipped].target_W.mm += 12.0 * way;
    const Rezero result = rezeroed(perfectly(rig), set);
    EXPECT_EQ(result.outliers, 1) << seed;
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(result.residuals[i].used, i != slipped) << seed << " " << i;
    EXPECT_LT(tre_mm(result.arm, now, seed), 0.6) << seed;
  }
}

TEST(Rezero, ShowsTwoOutliersInTheResidual) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    SyntheticRig rig = syntheticRig(Scenario::d, seed);
    rig.technician.outlier_share = 0.0;
    const SyntheticRig now = nightLater(rig, seed);
    TouchSet set = fiveTouches(now, seed);
    EXPECT_LT(rezeroed(perfectly(rig), set).after_rms_mm, 0.6) << seed;
    set.touches[seed % 5].target_W.mm += glm::dvec3(4.0, 6.0, -3.0);
    set.touches[(seed + 2) % 5].target_W.mm += glm::dvec3(5.0, -7.0, 2.0);
    EXPECT_GT(rezeroed(perfectly(rig), set).after_rms_mm, 0.6) << seed;
  }
}

TEST(Rezero, IgnoresUnusedTouches) {
  const SyntheticRig rig = exact(4), now = nightLater(rig, 4);
  TouchSet set = fiveTouches(now, 4);
  set.touches[2].target_W.mm.x += 100.0;
  set.touches[2].used = false;
  const Rezero result = rezeroed(perfectly(rig), set);
  EXPECT_EQ(result.outliers, 0);
  EXPECT_EQ(result.residuals.size(), 5u);
  EXPECT_FALSE(result.residuals[2].used);
  EXPECT_NEAR(glm::length(result.residuals[2].error_mm.xyz), 100.0, 0.5);
  EXPECT_LT(tre_mm(result.arm, now, 4), 0.05);
}

TEST(Rezero, RefusesInsufficientTouches) {
  const SyntheticRig rig = exact(5);
  const MeasuredArm arm = perfectly(rig);
  const TouchSet good = fiveTouches(rig, 5);

  TouchSet few = good;
  few.touches.resize(2);
  EXPECT_THROW(rezeroed(arm, few), CalibrationError);

  TouchSet twice = good;
  twice.touches[3] = twice.touches[1];
  EXPECT_THROW(rezeroed(arm, twice), CalibrationError);

  TouchSet wild = good;
  wild.touches[1].joints_rad[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(rezeroed(arm, wild), CalibrationError);
  wild = good;
  wild.touches[0].target_W.mm.z = std::numeric_limits<double>::infinity();
  EXPECT_THROW(rezeroed(arm, wild), CalibrationError);

  TouchSet line = good;
  for (std::size_t i = 0; i < line.touches.size(); ++i)
    line.touches[i].target_W.mm = {20.0 * static_cast<double>(i), 1.0, 2.0};
  EXPECT_THROW(rezeroed(arm, line), CalibrationError);
}

}  // namespace
}  // namespace calibration
