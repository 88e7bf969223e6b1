#include "calibration/synthetic/synthetic_rig.h"

#include <gtest/gtest.h>

#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr Scenario kScenarios[] = {Scenario::a, Scenario::b, Scenario::c, Scenario::d,
                                   Scenario::e, Scenario::f, Scenario::g};
constexpr glm::dvec3 kRegion_mm{70.0, 50.0, 35.0};

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// True stylus direction in W.
glm::dvec3 stylus_W(const SyntheticRig& rig, const RawJoints& raw_rad) {
  return (rig.X_WD.rotation * rig.arm.X_DH(raw_rad).rotation) * glm::dvec3(0.0, 0.0, 1.0);
}

double tiltSpread_deg(const SyntheticRig& rig, const std::vector<Touch>& touches) {
  double most = 0.0;
  for (const Touch& a : touches)
    for (const Touch& b : touches)
      most =
          std::max(most, std::acos(std::min(1.0, glm::dot(stylus_W(rig, a.joints_rad), stylus_W(rig, b.joints_rad)))));
  return degreesFromRad(most);
}

TEST(SyntheticRig, TouchesWithItsTrueTip) {
  // Without noise: from position to sensor readings and back.
  for (const Scenario scenario : kScenarios)
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
      SyntheticRig rig = syntheticRig(scenario, seed);
      rig.technician = {.precision = {0.0, 0.0}, .arm_noise_rad = 0.0, .gimbal_noise_rad = 0.0};
      std::mt19937 rng(seed);
      for (const Touch& touch : simulatedTouches(rig, *targetPlan("jig27"), rng).touches)
        ASSERT_LT(glm::length((rig.tip_W(touch.joints_rad) - touch.target_W).xyz), 1e-6)
            << static_cast<char>(scenario) << seed << " " << touch.id;
    }
}

TEST(SyntheticRig, IsTheSameForTheSameSeed) {
  const SyntheticRig one = syntheticRig(Scenario::d, 7), again = syntheticRig(Scenario::d, 7);
  const SyntheticRig other = syntheticRig(Scenario::d, 8);
  std::mt19937 a(5), b(5), c(5);
  const auto touches = simulatedTouches(one, *targetPlan("jig27"), a).touches;
  const auto same = simulatedTouches(again, *targetPlan("jig27"), b).touches;
  const auto others = simulatedTouches(other, *targetPlan("jig27"), c).touches;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    EXPECT_EQ(touches[i].joints_rad, same[i].joints_rad);
    EXPECT_NE(touches[i].joints_rad, others[i].joints_rad);
  }
  EXPECT_EQ(one.nominal.device->serial, "SIM-D7");
}

TEST(SyntheticRig, DrawsTheSameNumbersOnEveryMachine) {
  const SyntheticRig rig = syntheticRig(Scenario::d, 1);
  EXPECT_NEAR(rig.arm.truth.thigh_delta_mm, -0.735549153783, 1e-9);
  EXPECT_NEAR(rig.X_WD.translation_mm.x, 4.139276222326, 1e-9);
}

TEST(SyntheticRig, HasTheErrorSizesOfItsScenario) {
  struct Sizes {
    Scenario scenario;
    double link_mm, offset_deg, gimbal_deg, tip_mm;
  };
  for (const Sizes& sizes : {Sizes{Scenario::a, 0.15, 0.15, 0.3, 0.1},
                             {Scenario::b, 0.4, 0.5, 1.0, 0.4},
                             {Scenario::c, 0.8, 1.5, 2.0, 0.8},
                             {Scenario::d, 0.4, 0.5, 1.0, 0.4}}) {
    std::vector<double> link, offset, gimbal, tip;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
      const ArmCorrection truth = syntheticRig(sizes.scenario, seed).arm.truth;
      link.insert(link.end(), {truth.thigh_delta_mm, truth.shin_delta_mm});
      for (std::size_t i = 0; i < 3; ++i) {
        offset.push_back(degreesFromRad(truth.offset_rad[i]));
        gimbal.push_back(degreesFromRad(truth.offset_rad[i + 3]));
        tip.push_back((truth.tip_H_mm - kNominalTip_H_mm)[static_cast<int>(i)]);
      }
    }
    // Five sigma of the RMS of this many.
    EXPECT_NEAR(rms(link) / sizes.link_mm, 1.0, 0.13);
    EXPECT_NEAR(rms(offset) / sizes.offset_deg, 1.0, 0.11);
    EXPECT_NEAR(rms(gimbal) / sizes.gimbal_deg, 1.0, 0.11);
    EXPECT_NEAR(rms(tip) / sizes.tip_mm, 1.0, 0.11);
  }
}

TEST(SyntheticRig, BendsByTheSizeOfItsScenario) {
  const auto bent_mm = [](Scenario scenario) {
    std::vector<double> bent;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
      const SyntheticRig rig = syntheticRig(scenario, seed);
      PerturbedArm straight = rig.arm;
      straight.warp = {};
      std::mt19937 rng(seed);
      for (const Touch& touch : heldOutTouches(rig, 20, kRegion_mm, rng))
        bent.push_back(glm::length((rig.arm.tip_D(touch.joints_rad) - straight.tip_D(touch.joints_rad)).xyz));
    }
    return rms(bent);
  };
  EXPECT_EQ(bent_mm(Scenario::b), 0.0);
  EXPECT_NEAR(bent_mm(Scenario::d), 0.15, 0.015);
  EXPECT_NEAR(bent_mm(Scenario::g), 0.5, 0.05);
}

TEST(SyntheticRig, HasTheKnownErrorWithoutCalibration) {
  // True device pose, nominal arm: 2.1 mm, median over rigs.
  std::vector<double> of_rigs;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const SyntheticRig rig = syntheticRig(Scenario::d, seed);
    std::mt19937 rng(seed);
    std::vector<double> off;
    for (const Touch& touch : heldOutTouches(rig, 100, kRegion_mm, rng)) {
      const MeasuredArm model{rig.arm.geometry, {}, rig.X_WD};
      off.push_back(glm::length((model.tip_W(touch.joints_rad) - touch.target_W).xyz));
    }
    of_rigs.push_back(rms(off));
  }
  std::sort(of_rigs.begin(), of_rigs.end());
  EXPECT_NEAR(of_rigs[30], 2.1, 0.4);
}

TEST(SyntheticRig, ReachesItsTargetsUnmoved) {
  int moved = 0, all = 0;
  for (const char* method : {"jig27", "jig8", "visual25", "webcam27", "rezero5", "check4", "verify8", "pivot12"})
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
      const SyntheticRig rig = syntheticRig(Scenario::d, seed);
      std::mt19937 rng(seed);
      const auto plan = targetPlan(method);
      const auto touches = simulatedTouches(rig, *plan, rng).touches;
      ASSERT_EQ(touches.size(), plan->targets.size()) << method << seed;
      for (std::size_t i = 0; i < touches.size(); ++i)
        moved += touches[i].target_W.mm != plan->targets[i].position_W.mm ? 1 : 0;
      all += static_cast<int>(touches.size());
    }
  EXPECT_LE(moved, all / 100) << "of " << all;
}

TEST(SyntheticRig, TiltsTheStylusAsRequestedExceptInScenarioE) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const SyntheticRig many = syntheticRig(Scenario::d, seed), one = syntheticRig(Scenario::e, seed);
    std::mt19937 a(seed), b(seed);
    EXPECT_GE(tiltSpread_deg(many, simulatedTouches(many, *targetPlan("jig27"), a).touches), 45.0);
    EXPECT_LT(tiltSpread_deg(one, simulatedTouches(one, *targetPlan("jig27"), b).touches), 20.0);
    std::mt19937 c(seed);
    EXPECT_GE(tiltSpread_deg(one, heldOutTouches(one, 100, kRegion_mm, c)), 45.0) << "judged by all tilts all the same";
  }
}

TEST(SyntheticRig, TouchesWithTheStatedPrecision) {
  const SyntheticRig rig = [] {
    SyntheticRig it = syntheticRig(Scenario::f, 3);
    it.technician.outlier_share = it.technician.arm_noise_rad = it.technician.gimbal_noise_rad = 0.0;
    return it;
  }();
  std::mt19937 rng(1);
  std::vector<double> across, along;
  for (int n = 0; n < 40; ++n)
    for (const Touch& touch : simulatedTouches(rig, *targetPlan("visual25"), rng).touches) {
      const glm::dvec3 off = (rig.tip_W(touch.joints_rad) - touch.target_W).xyz;
      across.insert(across.end(), {off.x, off.y});
      along.push_back(off.z);
    }
  EXPECT_NEAR(rms(across), 0.3, 0.03);
  EXPECT_NEAR(rms(along), 1.0, 0.1);
}

TEST(SyntheticRig, HasTheStatedShareOfOutliers) {
  int slipped = 0, all = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const SyntheticRig rig = syntheticRig(Scenario::d, seed);
    std::mt19937 rng(seed);
    for (const Touch& touch : simulatedTouches(rig, *targetPlan("jig27"), rng).touches) {
      const double off_mm = glm::length((rig.tip_W(touch.joints_rad) - touch.target_W).xyz);
      EXPECT_LT(off_mm, 21.0);
      slipped += off_mm > 4.0 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_NEAR(slipped / static_cast<double>(all), 0.02, 0.015);
}

TEST(SyntheticRig, DriftsByTheRequestedSigmas) {
  std::vector<double> turned, shifted;
  std::mt19937 rng(9);
  const SyntheticRig rig = syntheticRig(Scenario::d, 1);
  for (int n = 0; n < 300; ++n) {
    const SyntheticRig moved = drifted(rig, 0.3, 1.0, rng);
    for (std::size_t i = 0; i < 3; ++i) {
      turned.push_back(degreesFromRad(moved.arm.truth.offset_rad[i] - rig.arm.truth.offset_rad[i]));
      shifted.push_back((moved.X_WD.translation_mm - rig.X_WD.translation_mm)[static_cast<int>(i)]);
    }
    EXPECT_EQ(moved.arm.truth.offset_rad[3], rig.arm.truth.offset_rad[3]);
    EXPECT_EQ(moved.X_WD.rotation, rig.X_WD.rotation);
  }
  EXPECT_NEAR(rms(turned), 0.3, 0.04);
  EXPECT_NEAR(rms(shifted), 1.0, 0.12);
}

TEST(SyntheticRig, NamesScenariosByLetter) {
  for (const Scenario scenario : kScenarios)
    EXPECT_EQ(scenarioNamed(std::string(1, static_cast<char>(scenario))), scenario);
  for (const char* none : {"", "H", "d", "DD", "@"}) EXPECT_FALSE(scenarioNamed(none)) << none;
}

}  // namespace
}  // namespace calibration
