#include "calibration/fit/quick_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/arm/phantom_models.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace {

using namespace calibration;

MeasuredArm believed(const SyntheticRig& rig) { return {kOmniGeometry, {}, rig.nominal.X_WD}; }

TouchSet touchesOf(Scenario scenario, std::uint32_t seed, const char* method = "jig27") {
  SyntheticRig rig = syntheticRig(scenario, seed);
  rig.technician.outlier_share = 0.0;
  std::mt19937 rng(seed);
  return simulatedTouches(rig, *targetPlan(method), rng);
}

TEST(QuickFit, FitsATypicalArmWithinTwoMillimetresFromEightTouches) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const SyntheticRig rig = syntheticRig(Scenario::d, seed);
    const QuickFit quick = quickFit(believed(rig), touchesOf(Scenario::d, seed, "jig8"));
    std::mt19937 rng(seed + 100);
    double sum_mm2 = 0.0;
    for (const Touch& touch : heldOutTouches(rig, 100, glm::dvec3(30.0), rng)) {
      const double off_mm = glm::length(quick.arm.tip_W(touch.joints_rad).mm - touch.target_W.mm);
      sum_mm2 += off_mm * off_mm / 100.0;
    }
    EXPECT_LT(std::sqrt(sum_mm2), 2.0) << seed;
  }
}

TEST(QuickFit, FlagsATouchOfTheWrongTargetOnly) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    TouchSet set = touchesOf(Scenario::d, seed);
    const std::size_t wrong = seed % set.touches.size();
    set.touches[wrong].target_W.mm += glm::dvec3(0.0, 15.0, 0.0);
    const QuickFit quick = quickFit(believed(syntheticRig(Scenario::d, seed)), set);
    for (std::size_t i = 0; i < set.touches.size(); ++i) EXPECT_EQ(quick.doubtful[i], i == wrong) << seed << " " << i;
    EXPECT_NEAR(glm::length(quick.left_out_mm[wrong].xyz), 15.0, 2.0) << seed;
  }
}

TEST(QuickFit, SeldomFlagsGoodTouches) {
  int doubted = 0, all = 0;
  for (const Scenario scenario : {Scenario::a, Scenario::b, Scenario::c, Scenario::d, Scenario::g})
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      const QuickFit quick = quickFit(believed(syntheticRig(scenario, seed)), touchesOf(scenario, seed));
      doubted += static_cast<int>(std::count(quick.doubtful.begin(), quick.doubtful.end(), true));
      all += static_cast<int>(quick.doubtful.size());
    }
  std::printf("doubted without reason: %d of %d\n", doubted, all);
  EXPECT_LT(doubted, all / 50);
}

/// Linearised leave-one-out against real refits.
TEST(QuickFit, PredictsTheLeaveOneOutResidual) {
  const TouchSet set = touchesOf(Scenario::d, 5, "jig8");  // so few that each has much influence
  const MeasuredArm start = believed(syntheticRig(Scenario::d, 5));
  const QuickFit quick = quickFit(start, set);
  for (std::size_t i = 0; i < set.touches.size(); ++i) {
    TouchSet others = set;
    others.touches.erase(others.touches.begin() + static_cast<std::ptrdiff_t>(i));
    const Point<World> predicted = quickFit(start, others).arm.tip_W(set.touches[i].joints_rad);
    const glm::dvec3 left_out_mm = predicted.mm - set.touches[i].target_W.mm;
    EXPECT_LT(glm::length(left_out_mm - quick.left_out_mm[i].xyz), 0.15 * glm::length(left_out_mm) + 0.05) << i;
  }
}

TEST(QuickFit, KeepsTheArmForFewerThanFourTouches) {
  TouchSet set = touchesOf(Scenario::d, 1);
  set.touches.resize(3);
  const MeasuredArm start = believed(syntheticRig(Scenario::d, 1));
  const QuickFit quick = quickFit(start, set);
  EXPECT_EQ(quick.arm.X_WD.translation_mm, start.X_WD.translation_mm);
  EXPECT_EQ(std::count(quick.doubtful.begin(), quick.doubtful.end(), true), 0);
}

}  // namespace
