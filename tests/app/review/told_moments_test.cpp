#include "app/review/told_moments.h"

#include <gtest/gtest.h>

namespace app {
namespace {

SessionMetrics withMeasures(std::vector<MeasureValue> measures) {
  SessionMetrics metrics;
  metrics.measures = std::move(measures);
  return metrics;
}

TEST(ToldMoments, AreErrorsAndTheNearestPlacesInOrderOfTime) {
  const SessionMetrics metrics = withMeasures({{"S1.canal", "", "mm", 1.25, {}, 50.0},
                                               {"S1.second_molar", "", "mm", -0.1, {}, 20.0},
                                               {"S1.lingual", "", "mm", {}, "none", {}},
                                               {"O5.area", "", "mm2", 2.0, {}, 30.0},
                                               {"O10.second_molar", "", "mm3", 0.0, {}, {}}});
  const std::vector<ToldMoment> told = toldMoments(metrics, {});
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[0].what, "nearest to the second molar, \u22120.10 mm");
  EXPECT_EQ(told[1].what, "lingual plate broken through");
  EXPECT_EQ(told[2].what, "nearest to the mandibular canal, 1.25 mm");
}

TEST(ToldMoments, WhatHappenedTogetherIsOneMoment) {
  const SessionMetrics metrics =
      withMeasures({{"O5.area", "", "mm2", 2.0, {}, 30.0}, {"S1.lingual", "", "mm", -0.2, {}, 30.1}});
  const std::vector<ToldMoment> told = toldMoments(metrics, {});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].what, "lingual plate broken through; nearest to the outer lingual surface, \u22120.20 mm");
}

TEST(ToldMoments, AreBoundedAndTheLighterOnesAreLeftOut) {
  SessionCourse course;
  for (int n = 0; n < 20; ++n)
    course.marks.push_back({static_cast<double>(n), MarkKind::coach, "message " + std::to_string(n)});
  course.marks.push_back({90.0, MarkKind::touch, "lower right second molar touched"});
  course.marks.push_back({95.0, MarkKind::touch, "lower right second molar touched"});
  course.marks.push_back({91.0, MarkKind::error, "cutting dry"});
  const std::vector<ToldMoment> told = toldMoments(withMeasures({{"S1.canal", "", "mm", 1.25, {}, 92.0}}), course);
  ASSERT_EQ(told.size(), kMostTold);
  EXPECT_EQ(told[4].what, "coach: message 4");
  EXPECT_EQ(told[5].what, "lower right second molar touched") << "the first of a kind";
  EXPECT_EQ(told[6].what, "cutting dry");
  EXPECT_EQ(told[7].t_s, 92.0);
}

TEST(ToldMoments, APictureIsFoundByItsMoment) {
  const std::vector<MomentPicture> pictures{{{1.0, "a"}, 0.0, {}}, {{2.0, "b"}, 0.0, {}}};
  EXPECT_EQ(pictureOf(pictures, 2.1), 1U);
  EXPECT_FALSE(pictureOf(pictures, 1.5));
}

}  // namespace
}  // namespace app
