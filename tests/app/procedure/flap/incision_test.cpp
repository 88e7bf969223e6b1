#include "app/procedure/flap/incision.h"

#include <gtest/gtest.h>

#include "tests/app/procedure/flap/ridge.h"

namespace app {
namespace {

TEST(GumChart, KnowsDepthAndBoneUnderEachPlace) {
  const Ridge ridge;
  const GumChart chart(ridge.gum, ridge.patient.ct, ridge.cut);
  for (const double angle : {-0.8, 0.0, 0.5, 1.2})
    for (const double deep_mm : {0.3, 1.0, 1.8}) {
      const double r_mm = Ridge::kGum_mm - deep_mm;
      EXPECT_NEAR(chart.depth_mm({r_mm * std::sin(angle), 2.2, r_mm * std::cos(angle)}), deep_mm, 0.03) << angle;
    }
  const ChartPlace above = chart.placeOf({0.0, -3.0, 30.0});
  EXPECT_NEAR(glm::distance(chart.surface_P_mm(above), glm::dvec3(0.0, -3.0, Ridge::kGum_mm)), 0.0, 0.02);
  EXPECT_NEAR(chart.gum_mm(above) - chart.bone_mm(above), Ridge::kGum_mm - Ridge::kBone_mm, 0.1);
  EXPECT_NEAR(glm::dot(chart.normal_P(above), glm::dvec3(0.0, 0.0, 1.0)), 1.0, 1e-3);
}

TEST(Incision, IsAsLongAsTheCutThatWasDrawn) {
  WorkedRidge worked;
  worked.incise();
  const double drawn_mm = worked.flap.plan().incisionLength_mm();
  EXPECT_GT(drawn_mm, 20.0);
  EXPECT_NEAR(worked.flap.incision().length_mm(), drawn_mm, 0.05 * drawn_mm);
  EXPECT_GT(worked.flap.incision().fullShare(), 0.97);
}

TEST(Incision, IsNotLengthenedByTremorOrBySecondStrokes) {
  WorkedRidge worked;
  worked.incise(0.3, true, 0.12);
  const double once_mm = worked.flap.incision().length_mm(), drawn_mm = worked.flap.plan().incisionLength_mm();
  EXPECT_NEAR(once_mm, drawn_mm, 0.05 * drawn_mm);
  worked.incise(0.3, true, 0.12);
  EXPECT_NEAR(worked.flap.incision().length_mm(), once_mm, 1.5);
}

TEST(Incision, IsFullWhereTheBladeMetBoneAlone) {
  WorkedRidge shallow;
  shallow.incise(1.2, false);
  EXPECT_GT(shallow.flap.incision().length_mm(), 20.0);
  EXPECT_EQ(shallow.flap.incision().fullShare(), 0.0);
  for (const IncisionPoint& point : shallow.flap.incision().points()) EXPECT_NEAR(point.depth_mm, 1.05, 0.25);
  shallow.incise(0.3, true);
  EXPECT_GT(shallow.flap.incision().fullShare(), 0.95) << "deepened";
}

TEST(Incision, BeginsInTheGumAlone) {
  WorkedRidge worked;
  worked.incise(2.5, false);
  EXPECT_TRUE(worked.flap.incision().points().empty());
}

}  // namespace
}  // namespace app
