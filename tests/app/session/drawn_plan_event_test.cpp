#include "app/session/drawn_plan_event.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(DrawnPlanEvent, ReadsBackWhatItWrote) {
  DrawnPlan plan;
  plan[DrawnLine::trough] = {{-28.25, 49.0, 2.5}, {-20.0, 51.5, 2.75}};
  EXPECT_EQ(drawnPlanFrom(drawnPlanText(plan)), plan);
  EXPECT_EQ(drawnPlanFrom(drawnPlanText({})), DrawnPlan{});
  DrawnComparison comparison;
  comparison[1] =
      DrawnCut{.length_mm = 8.0, .followed_share = 0.75, .removed_mm3 = 40.5, .beside_mm3 = 2.25, .off_mm = 0.5};
  EXPECT_EQ(drawnCutFrom(drawnCutText(comparison)), comparison);
  EXPECT_EQ(drawnCutInWords(comparison), "section: 75 % of 8 mm followed, 2 of 40 mm³ beside it");
  EXPECT_EQ(drawnCutInWords({}), "");
}

TEST(DrawnPlanEvent, IsNotReadFromOtherWords) {
  for (const char* const text :
       {"", "[]", "{}", R"({"trough_P_mm": []})", R"({"trough_P_mm": [[0, 1]], "section_P_mm": []})",
        R"({"trough_P_mm": [[0, 1, 1e9]], "section_P_mm": []})",
        R"({"trough_P_mm": [[0, 1, "2"]], "section_P_mm": []})"})
    EXPECT_FALSE(drawnPlanFrom(text)) << text;
  for (const char* const text :
       {"", "{}", R"({"trough": null})", R"({"trough": {}, "section": null})",
        R"({"trough": {"length_mm": 3, "followed_share": 2, "removed_mm3": 1, "beside_mm3": 1,)"
        R"( "off_mm": 1}, "section": null})"})
    EXPECT_FALSE(drawnCutFrom(text)) << text;
}

TEST(DrawnPlanEvent, HasTheLengthOfItsLines) {
  EXPECT_DOUBLE_EQ(lengthOf_mm({{0, 0, 0}, {3, 4, 0}, {3, 4, 2}}), 7.0);
  EXPECT_EQ(lengthOf_mm({{1, 2, 3}}), 0.0);
}

}  // namespace
}  // namespace app
