#include "calibration/fit/arm_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/arm/phantom_models.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;
using Kind = FitWarning::Kind;

constexpr glm::dvec3 kHalf_mm{65.0, 45.0, 32.5};

/// Touches of a synthetic workstation, and held-out touches for verification.
struct Trial {
  TouchSet set;
  std::vector<Touch> held_out;

  Trial(Scenario scenario, std::uint32_t seed, const char* method, double outlier_share = 0.0) {
    SyntheticRig rig = syntheticRig(scenario, seed);
    rig.technician.outlier_share = outlier_share;
    std::mt19937 rng(seed + 100);
    set = simulatedTouches(rig, targetPlan(method).value(), rng);
    held_out = heldOutTouches(rig, 100, kHalf_mm, rng);
  }
};

/// A unit of any model with correctable errors only, at any pose.
struct ExactUnit {
  PerturbedArm arm;
  Pose<World, Device> X_WD;
  std::mt19937 rng;
  std::normal_distribution<double> normal;

  ExactUnit(const PhantomModel& model, std::uint32_t seed) : rng(seed) {
    arm.geometry = model.geometry;
    for (std::size_t i = 0; i < 6; ++i) {
      arm.truth.offset_rad[i] = radFromDegrees(i < 3 ? 0.5 : 1.0) * normal(rng);
      arm.truth.gain[i] = (i < 3 ? 0.004 : 0.01) * normal(rng);
    }
    arm.truth.thigh_delta_mm = 0.4 * normal(rng);
    arm.truth.tip_H_mm += 0.4 * glm::dvec3(normal(rng), normal(rng), normal(rng));
    X_WD = {glm::angleAxis(kPi - 0.3 + 0.1 * normal(rng), glm::dvec3(0, 1, 0)), {20.0, -110.0, -35.0}};
  }

  std::vector<Touch> touches(int n, double noise_mm) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Touch> touches;
    const glm::dvec3 middle = wristPosition(arm.geometry, {0.0, 0.5, -0.2}).mm;
    while (static_cast<int>(touches.size()) < n) {
      const auto reached =
          armAnglesFor(arm.geometry, {middle + glm::dvec3(60.0 * unit(rng), 40.0 * unit(rng), 30.0 * unit(rng))});
      if (!reached) continue;
      const RawJoints raw{reached->x, reached->y, reached->z, 0.5 * unit(rng), 0.5 * unit(rng), 0.5 * unit(rng)};
      Touch touch{static_cast<int>(touches.size()) + 1, raw, X_WD * arm.tip_D(raw), true};
      touch.target_W.mm += noise_mm * glm::dvec3(normal(rng), normal(rng), normal(rng));
      touches.push_back(touch);
    }
    return touches;
  }
};

double rms_mm(const MeasuredArm& arm, const std::vector<Touch>& touches) {
  double sum = 0.0;
  for (const Residual& residual : residualsOf(arm, touches)) sum += std::pow(glm::length(residual.error_mm.xyz), 2);
  return std::sqrt(sum / static_cast<double>(touches.size()));
}

bool warnsOf(const ArmFit& fit, Kind kind) {
  return std::ranges::any_of(fit.warnings, [&](const FitWarning& warning) { return warning.kind == kind; });
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

std::string refusal(const TouchSet& set) {
  return tests::refusalOf<CalibrationError>([&] { fitArm(set); });
}

TouchSet flipped(TouchSet set, int axis) {
  for (Touch& touch : set.touches) touch.target_W.mm[axis] *= -1.0;
  return set;
}

TEST(ArmFit, FindsEveryModelWithoutNoiseAtAnyPose) {
  for (const PhantomModel& model : kPhantomModels) {
    ExactUnit unit(model, 3);
    const TouchSet set{.device_model = std::string(model.key),
                       .serial = {},
                       .mount = {},
                       .method = {},
                       .precision = kPitPrecision,
                       .touches = unit.touches(40, 0.0)};
    const ArmFit fit = fitArm(set);
    EXPECT_EQ(fit.model, ArmModel::full) << model.key;
    EXPECT_LT(rms_mm(fit.arm, unit.touches(100, 0.0)), 0.01) << model.key;
    EXPECT_EQ(fit.outliers, 0) << model.key;
  }
}

TEST(ArmFit, EstimatesTheModelError) {
  ExactUnit unit(kPhantomModels[0], 5);
  const TouchSet set{.device_model = "omni",
                     .serial = {},
                     .mount = {},
                     .method = {},
                     .precision = {0.05, 0.05},
                     .touches = unit.touches(200, 0.3)};
  const ArmFit fit = fitArm(set);
  EXPECT_NEAR(fit.mismatch_mm, std::sqrt(0.3 * 0.3 - 0.05 * 0.05), 0.03);
  EXPECT_EQ(fit.sigma.size(), kArmPriorSigma.size());
  EXPECT_GT(fit.sigma[9], 0.0);
}

TEST(ArmFit, IsTwiceAsGoodAsARigidFit) {
  std::vector<double> full, rigid, honest;
  for (std::uint32_t seed = 1; seed <= 9; ++seed) {
    const Trial trial(Scenario::d, seed, "jig27", 0.02);
    const ArmFit fit = fitArm(trial.set);
    full.push_back(rms_mm(fit.arm, trial.held_out));
    rigid.push_back(rms_mm(fitArm(trial.set, {.model = ArmModel::rigid}).arm, trial.held_out));
    honest.push_back(fit.cv_rms_mm / full.back());
  }
  EXPECT_LT(median(full), 0.28);
  EXPECT_LT(*std::ranges::max_element(full), 0.37);
  EXPECT_GT(median(rigid), 2.0 * median(full));
  EXPECT_GT(median(honest), 0.9);
  EXPECT_LT(median(honest), 1.4);
}

TEST(ArmFit, IsGoodWithEightTouchesAndWithCrosses) {
  std::vector<double> eight, by_eye;
  for (std::uint32_t seed = 1; seed <= 9; ++seed) {
    const Trial few(Scenario::d, seed, "jig8"), crosses(Scenario::f, seed, "visual25");
    eight.push_back(rms_mm(fitArm(few.set).arm, few.held_out));
    by_eye.push_back(rms_mm(fitArm(crosses.set).arm, crosses.held_out));
  }
  EXPECT_LT(median(eight), 0.45);
  EXPECT_LT(median(by_eye), 0.7);
}

TEST(ArmFit, NamesAnOutlierAndIsNotChangedByIt) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const Trial trial(Scenario::d, seed, "jig27");
    TouchSet spoilt = trial.set;
    const std::size_t wild = 5 * seed;
    spoilt.touches[wild].target_W.mm += glm::dvec3(-9.0, 10.0, 6.6);
    const ArmFit fit = fitArm(spoilt);
    EXPECT_EQ(fit.outliers, 1);
    EXPECT_FALSE(fit.residuals[wild].used);
    EXPECT_NEAR(glm::length(fit.residuals[wild].error_mm.xyz), 15.0, 1.5);
    EXPECT_NEAR(rms_mm(fit.arm, trial.held_out), rms_mm(fitArm(trial.set).arm, trial.held_out), 0.05);
  }
}

TEST(ArmFit, IgnoresUnusedTouches) {
  Trial trial(Scenario::b, 2, "jig27");
  trial.set.touches[4].used = false;
  trial.set.touches[4].target_W.mm.x += 30.0;
  const ArmFit fit = fitArm(trial.set);
  EXPECT_EQ(fit.used, 26);
  EXPECT_EQ(fit.outliers, 0);
  ASSERT_EQ(fit.residuals.size(), 27u);
  EXPECT_FALSE(fit.residuals[4].used);
}

TEST(ArmFit, ReportsEveryModelItTried) {
  const ArmFit fit = fitArm(Trial(Scenario::d, 1, "jig27").set);
  ASSERT_EQ(fit.scores.size(), 4u);
  EXPECT_EQ(fit.scores[0].name, "rigid");
  EXPECT_EQ(fit.scores[2].name, "full");
  EXPECT_EQ(fit.scores[2].parameters, 28);
  EXPECT_EQ(fit.scores[3].name, "affine");
  EXPECT_LT(fit.scores[2].fre_rms_mm, fit.scores[0].fre_rms_mm);
  EXPECT_GT(fit.scores[3].cv_rms_mm, fit.scores[2].cv_rms_mm);
  EXPECT_EQ(armModelNamed(nameOf(ArmModel::joint_gains)), ArmModel::joint_gains);
  EXPECT_FALSE(armModelNamed("affine"));
}

TEST(ArmFit, SelectsNoFullModelWithoutTiltVarietyAndWarns) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const ArmFit fit = fitArm(Trial(Scenario::e, seed, "jig27").set);
    EXPECT_NE(fit.model, ArmModel::full);
    EXPECT_TRUE(warnsOf(fit, Kind::little_tilt));
    EXPECT_LT(fit.tilt_spread_deg, 25.0);
    EXPECT_FALSE(warnsOf(fitArm(Trial(Scenario::d, seed, "jig27").set), Kind::little_tilt));
  }
}

TEST(ArmFit, WarnsOfFewTouches) {
  Trial trial(Scenario::d, 3, "jig27");
  EXPECT_TRUE(fitArm(trial.set).warnings.empty());
  trial.set.touches.resize(15);
  EXPECT_TRUE(warnsOf(fitArm(trial.set), Kind::few_touches));
  trial.set.touches.resize(7);
  const ArmFit fit = fitArm(trial.set);
  EXPECT_NE(fit.model, ArmModel::full);
}

TEST(ArmFit, WarnsOfASmallVolume) {
  const Trial trial(Scenario::d, 3, "jig27");
  const double hull_mm3 = fitArm(trial.set).hull_mm3;
  EXPECT_NEAR(hull_mm3, 130.0 * 90.0 * 65.0, 0.05 * hull_mm3);
  EXPECT_FALSE(warnsOf(fitArm(trial.set, {.model = {}, .region_mm3 = 1.5 * hull_mm3}), Kind::small_volume));
  EXPECT_TRUE(warnsOf(fitArm(trial.set, {.model = {}, .region_mm3 = 1.8 * hull_mm3}), Kind::small_volume));
}

TEST(ArmFit, WarnsOfManyOutliers) {
  Trial trial(Scenario::d, 4, "jig27");
  for (const std::size_t i : {2u, 9u, 20u}) trial.set.touches[i].target_W.mm.y += 12.0;
  const ArmFit fit = fitArm(trial.set);
  EXPECT_EQ(fit.outliers, 3);
  EXPECT_TRUE(warnsOf(fit, Kind::many_outliers));
}

TEST(ArmFit, RefusesAMirroredImage) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed)
    for (const char* method : {"jig27", "jig8"})
      for (const int axis : {0, 1, 2})
        EXPECT_THAT(refusal(flipped(Trial(Scenario::c, seed, method, 0.05).set, axis)), HasSubstr("mirror"));
}

TEST(ArmFit, WarnsOfAMirroredImageWithPlanarTargets) {
  // Rotated by half a turn the touches fit as well: only the stylus direction gives it away.
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const Trial trial(Scenario::f, seed, "visual15");
    EXPECT_FALSE(warnsOf(fitArm(trial.set), Kind::mirrored));
    EXPECT_TRUE(warnsOf(fitArm(flipped(trial.set, 0)), Kind::mirrored));
    EXPECT_TRUE(warnsOf(fitArm(flipped(trial.set, 1)), Kind::mirrored));
  }
}

TEST(ArmFit, RefusesTouchesThatNoPoseExplains) {
  Trial trial(Scenario::d, 5, "jig27");
  TouchSet other_device = trial.set;
  other_device.device_model = "premium";
  EXPECT_THAT(refusal(other_device), HasSubstr("check device model"));
  for (std::size_t i = 0; i + 9 < trial.set.touches.size(); ++i)
    std::swap(trial.set.touches[i].target_W, trial.set.touches[i + 9].target_W);
  EXPECT_THAT(refusal(trial.set), HasSubstr("order"));
}

TEST(ArmFit, AcceptsNominalTouches) {
  for (const std::size_t n : {4u, 5u, 6u, 7u}) {
    Trial trial(Scenario::a, 7, "jig8");
    trial.set.touches.resize(n);
    const ArmFit fit = fitArm(trial.set);
    EXPECT_LT(rms_mm(fit.arm, trial.held_out), 1.5) << n;
    EXPECT_TRUE(warnsOf(fit, Kind::few_touches));
    EXPECT_TRUE(std::isfinite(fit.cv_rms_mm));
  }
}

}  // namespace
}  // namespace calibration
