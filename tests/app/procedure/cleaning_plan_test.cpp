#include "app/procedure/third_molar/cleaning_plan.h"

#include <variant>

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr glm::dvec3 kOut{0, 0, 1};
constexpr std::array<bool, kCleanings> kAll{true, true, true, true};

CleaningStep stepOf(const OperationStep& step) { return std::get<CleaningStep>(step.what); }

TEST(CleaningPlan, PlansWhatIsLeftInOrder) {
  SiteLeft left;
  left.chips_P_mm = {{0, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  left.stuck_P_mm = {{0, 5, 0}};
  left.edges = {{5.0, 0.3, {0, 0, 2}, {{-2, 0, 2}, {0, 0, 2}, {2, 0, 2}}}, {1.0, 0.3, {8, 8, 2}, {{8, 8, 2}}}};
  left.stitches_P_mm = {{0, 9, 0}, {0, 14, 0}};
  CleaningPlanner planner(kOut, kAll);
  auto step = planner.next(left);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(*step).what, Cleaning::suction);
  EXPECT_EQ(stepOf(*step).ways_P_mm.size(), 2u) << "chips within reach of one place go together";
  EXPECT_EQ(step->words, "suck away what is loose (2 places)");
  left.chips_P_mm.clear();
  step = planner.next(left);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(*step).what, Cleaning::curette);
  EXPECT_EQ(stepOf(*step).middle_P_mm, glm::dvec3(0, 5, 0));
  left.stuck_P_mm.clear();
  step = planner.next(left);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(*step).what, Cleaning::file);
  ASSERT_EQ(stepOf(*step).ways_P_mm.size(), 1u) << "a short edge is not worth it";
  EXPECT_EQ(stepOf(*step).ways_P_mm[0].size(), 3u);
  left.edges.clear();
  step = planner.next(left);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(*step).what, Cleaning::stitch);
  EXPECT_EQ(stepOf(*step).ways_P_mm.size(), 2u);
  EXPECT_FALSE(planner.next(left)) << "the round is over";
}

TEST(CleaningPlan, LeavesOutWhatNoInstrumentIsThereFor) {
  SiteLeft left;
  left.chips_P_mm = {{0, 0, 0}};
  left.stitches_P_mm = {{0, 9, 0}};
  CleaningPlanner planner(kOut, {false, false, false, true});
  const auto step = planner.next(left);
  ASSERT_TRUE(step);
  EXPECT_EQ(stepOf(*step).what, Cleaning::stitch);
  EXPECT_EQ(step->words, "confirm the stitches (1 place)");
}

TEST(CleaningPlan, ACleanSiteNeedsNothing) { EXPECT_FALSE(CleaningPlanner(kOut, kAll).next({})); }

}  // namespace
}  // namespace app
