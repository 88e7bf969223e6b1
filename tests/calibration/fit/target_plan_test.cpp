#include "calibration/fit/target_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr const char* kMethods[] = {"jig27",   "jig8",   "visual15", "visual25", "webcam27",
                                    "rezero5", "check4", "verify8",  "pivot12"};

TargetPlan planned(const char* method) { return targetPlan(method).value(); }

double between_deg(const Vector<World>& a, const Vector<World>& b) {
  return degreesFromRad(std::acos(std::clamp(glm::dot(a.xyz, b.xyz), -1.0, 1.0)));
}

TEST(TargetPlan, HasTheNumberOfTargetsInItsName) {
  EXPECT_EQ(targetPlan("jig27")->targets.size(), 27u);
  EXPECT_EQ(targetPlan("jig8")->targets.size(), 8u);
  EXPECT_EQ(targetPlan("visual15")->targets.size(), 15u);
  EXPECT_EQ(targetPlan("visual25")->targets.size(), 25u);
  EXPECT_EQ(targetPlan("webcam27")->targets.size(), 27u);
  EXPECT_EQ(targetPlan("rezero5")->targets.size(), 5u);
  EXPECT_EQ(targetPlan("check4")->targets.size(), 4u);
  EXPECT_EQ(targetPlan("verify8")->targets.size(), 16u);
  EXPECT_EQ(targetPlan("pivot12")->targets.size(), 12u);
  EXPECT_FALSE(targetPlan("jig28"));
  EXPECT_FALSE(targetPlan(""));
}

TEST(TargetPlan, HoldsTheStylusInManyWays) {
  for (const char* method : kMethods) {
    const TargetPlan plan = planned(method);
    double max_deg = 0.0;
    for (const Target& a : plan.targets) {
      ASSERT_NEAR(glm::length(a.stylus_W.xyz), 1.0, 1e-12);
      EXPECT_LT(between_deg(a.stylus_W, kRestingStylus_W), 36.0) << method << " " << a.id;
      for (const Target& b : plan.targets) max_deg = std::max(max_deg, between_deg(a.stylus_W, b.stylus_W));
    }
    EXPECT_GE(max_deg, 40.0) << method;
  }
}

TEST(TargetPlan, ChangesTheTiltFromEachTargetToTheNext) {
  for (const char* method : kMethods) {
    const TargetPlan plan = planned(method);
    for (std::size_t i = 1; i < plan.targets.size(); ++i)
      EXPECT_GE(between_deg(plan.targets[i - 1].stylus_W, plan.targets[i].stylus_W), 12.0) << method << " " << i;
  }
}

TEST(TargetPlan, GoesShortWays) {
  for (const char* method : {"jig27", "visual15", "visual25", "webcam27"}) {
    const TargetPlan plan = planned(method);
    for (std::size_t i = 1; i < plan.targets.size(); ++i)
      EXPECT_LT(glm::length((plan.targets[i].position_W - plan.targets[i - 1].position_W).xyz), 66.0)
          << method << " " << i;
  }
}

TEST(TargetPlan, HasUncorrelatedTiltsAndPositions) {
  // No correlation of tilt and position.
  const TargetPlan plan = planned("jig27");
  glm::dmat3 tied(0.0);
  for (const Target& target : plan.targets)
    for (int axis = 0; axis < 3; ++axis)
      tied[axis] += target.position_W.mm[axis] * (target.stylus_W.xyz - kRestingStylus_W.xyz);
  for (int axis = 0; axis < 2; ++axis)
    for (int along = 0; along < 3; ++along) EXPECT_NEAR(tied[along][axis], 0.0, 20.0);
}

TEST(TargetPlan, VerifiesAtUnseenPositionsAndTilts) {
  const auto fit = targetPlan("jig27"), verification = targetPlan("verify8");
  for (const Target& seen : verification->targets)
    for (const Target& used : fit->targets) {
      EXPECT_NE(seen.id, used.id);
      EXPECT_GT(glm::length((seen.position_W - used.position_W).xyz), 20.0);
      EXPECT_GT(between_deg(seen.stylus_W, used.stylus_W), 3.0);
    }
}

TEST(TargetPlan, GivesEveryTargetItsOwnNumber) {
  for (const char* method : kMethods) {
    const TargetPlan plan = planned(method);
    std::set<int> ids;
    for (const Target& target : plan.targets) ids.insert(target.id);
    EXPECT_EQ(ids.size(), plan.targets.size()) << method;
  }
}

TEST(TargetPlan, FollowsTheJigsPose) {
  const JigPose jig{{glm::angleAxis(0.4, glm::normalize(glm::dvec3(1, 2, 3))), {10.0, -20.0, 5.0}}};
  const auto plain = targetPlan("jig27"), moved = targetPlan("jig27", jig);
  for (std::size_t i = 0; i < plain->targets.size(); ++i) {
    EXPECT_LT(
        glm::distance((jig.X_WB * Point<Board>{plain->targets[i].position_W.mm}).mm, moved->targets[i].position_W.mm),
        1e-12);
    EXPECT_EQ(plain->targets[i].stylus_W.xyz, moved->targets[i].stylus_W.xyz) << "the hand stays where it is";
  }
  EXPECT_EQ(targetPlan("visual25", jig)->targets[0].position_W.mm, targetPlan("visual25")->targets[0].position_W.mm);
}

TEST(TargetPlan, HoldsTheHandleWithItsTipAtTheTarget) {
  Target target{1, {{3.0, -4.0, 5.0}}, {glm::normalize(glm::dvec3(0.3, -0.2, 0.9))}};
  for (const glm::dvec3 tip_H_mm : {kNominalTip_H_mm, glm::dvec3(1.0, -2.0, -38.0)}) {
    const auto X_WH = handleHolding(target, tip_H_mm);
    EXPECT_LT(glm::distance((X_WH * Point<Handle>{tip_H_mm}).mm, target.position_W.mm), 1e-12);
    EXPECT_LT(glm::distance((X_WH * Vector<Handle>{{0, 0, 1}}).xyz, target.stylus_W.xyz), 1e-12);
  }
  target.stylus_W = {{0.0, 0.0, -1.0}};
  EXPECT_LT(
      glm::distance((handleHolding(target, kNominalTip_H_mm) * Vector<Handle>{{0, 0, 1}}).xyz, target.stylus_W.xyz),
      1e-12);
}

}  // namespace
}  // namespace calibration
