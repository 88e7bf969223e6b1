#include "calibration/record/drift_review.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/record/utc.h"

namespace calibration {
namespace {

using testing::HasSubstr;

/// One a day: RMS about 0.3 mm, no bias, with this noise.
std::vector<DriftEntry> steadyDays(int n, double noise_mm = 0.03) {
  std::vector<DriftEntry> history;
  for (int day = 0; day < n; ++day) {
    const double to = day % 2 == 0 ? noise_mm : -noise_mm;
    history.push_back({utcOf(1795249200 + 86400LL * day), DriftKind::check, 4, 0.3 + to, {{to, -to, to}}});
  }
  return history;
}

TEST(DriftReview, ReportsAnEmptyHistory) {
  EXPECT_THAT(reviewOf({}).sentence, HasSubstr("No check"));
  EXPECT_FALSE(reviewOf({}).alarmed);
}

TEST(DriftReview, WaitsForEnoughChecks) {
  const DriftReview review = reviewOf(steadyDays(7));
  EXPECT_FALSE(review.limits[0]);
  EXPECT_THAT(review.sentence, HasSubstr("7 of the 8"));
  EXPECT_TRUE(reviewOf(steadyDays(8)).limits[0]);
}

TEST(DriftReview, IsSteadyWhereNothingChanges) {
  const DriftReview review = reviewOf(steadyDays(40));
  EXPECT_TRUE(review.alarms.empty());
  EXPECT_THAT(review.sentence, HasSubstr("Steady"));
  EXPECT_NEAR(review.limits[0]->centre, 0.3, 1e-12);
  EXPECT_EQ(review.limits[0]->n, kMaxBaseline);
}

TEST(DriftReview, ReportsAPushWithFiguresAndRemedy) {
  auto history = steadyDays(12);
  history.back().rms_mm = 1.42;
  const DriftReview review = reviewOf(history);
  ASSERT_EQ(review.alarms.size(), 1u);
  EXPECT_TRUE(review.alarmed);
  EXPECT_EQ(review.alarms[0].entry, 11u);
  EXPECT_EQ(review.alarms[0].rule, ControlRule::one_beyond_3);
  EXPECT_THAT(review.alarms[0].sentence, HasSubstr("2026-12-02: RMS 1.42 mm, beyond 3 sigma"));
  EXPECT_THAT(review.sentence, HasSubstr("Re-zero"));
}

TEST(DriftReview, ReportsTheDirectionOfACreep) {
  auto history = steadyDays(12);
  for (int day = 12; day < 17; ++day) {
    history.push_back(history[static_cast<std::size_t>(day % 2)]);
    history.back().bias_mm.xyz.y = 0.08;
  }
  const DriftReview review = reviewOf(history);
  ASSERT_FALSE(review.alarms.empty());
  for (const DriftAlarm& alarm : review.alarms) EXPECT_EQ(alarm.quantity, DriftQuantity::up);
  EXPECT_EQ(review.alarms[0].rule, ControlRule::four_of_5_beyond_1);
}

TEST(DriftReview, IsNotAlarmedByASmallError) {
  auto history = steadyDays(12);
  history.back().rms_mm = 0.0;
  EXPECT_TRUE(reviewOf(history).alarms.empty());
  history.back().bias_mm.xyz.x = -1.0;
  ASSERT_EQ(reviewOf(history).alarms.size(), 1u);
  EXPECT_EQ(reviewOf(history).alarms[0].quantity, DriftQuantity::right);
}

TEST(DriftReview, BeginsAnewWithACalibration) {
  auto history = steadyDays(12);
  history.back().rms_mm = 1.42;
  history.push_back({"2027-01-01T00:00:00Z", DriftKind::calibration, 16, 0.25, {}});
  const DriftReview review = reviewOf(history);
  EXPECT_TRUE(review.charted.empty());
  EXPECT_TRUE(review.alarms.empty());
  EXPECT_THAT(review.sentence, HasSubstr("since the last calibration"));
}

TEST(DriftReview, LimitsDoNotFollowTheCheckedValues) {
  // Limits come from the first twenty: a later creep does not move them.
  auto history = steadyDays(60);
  for (std::size_t day = 20; day < 60; ++day) history[day].rms_mm += 0.004 * static_cast<double>(day - 20);
  EXPECT_NEAR(reviewOf(history).limits[0]->centre, 0.3, 1e-12);
  EXPECT_TRUE(reviewOf(history).alarmed);
}

}  // namespace
}  // namespace calibration
