#include "calibration/verification/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace calibration {
namespace {

using testing::HasSubstr;

std::vector<Residual> residualsWith(const std::vector<glm::dvec3>& errors_mm) {
  std::vector<Residual> residuals;
  for (const glm::dvec3& error : errors_mm)
    residuals.push_back({static_cast<int>(residuals.size()) + 1, {}, {error}, true});
  return residuals;
}

/// Sixteen errors of equal length in all directions.
TargetErrors evenErrors(double length_mm, int n = 16) {
  std::vector<glm::dvec3> errors;
  for (int i = 0; i < n; ++i) {
    glm::dvec3 error{0.0};
    error[(i / 2) % 3] = i % 2 == 0 ? length_mm : -length_mm;
    errors.push_back(error);
  }
  return targetErrors(residualsWith(errors));
}

TEST(TargetErrors, AreTheTextbookFigures) {
  auto residuals = residualsWith({{3, 4, 0}, {0, 0, 1}, {0, 0, -2}, {1, 0, 0}});
  residuals.push_back({9, {}, {{100, 0, 0}}, false});
  const TargetErrors errors = targetErrors(residuals);
  EXPECT_EQ(errors.n, 4);
  EXPECT_NEAR(errors.mean_mm, (5.0 + 1.0 + 2.0 + 1.0) / 4.0, 1e-12);
  EXPECT_NEAR(errors.rms_mm, std::sqrt((25.0 + 1.0 + 4.0 + 1.0) / 4.0), 1e-12);
  EXPECT_NEAR(errors.max_mm, 5.0, 1e-12);
  EXPECT_NEAR(errors.p95_mm, 2.0 + 0.85 * 3.0, 1e-12);
  EXPECT_LT(glm::distance(errors.bias_mm.xyz, glm::dvec3(1.0, 1.0, -0.25)), 1e-12);
  EXPECT_NEAR(errors.in_plane_rms_mm, std::sqrt(26.0 / 4.0), 1e-12);
  EXPECT_NEAR(errors.along_sight_rms_mm, std::sqrt(5.0 / 4.0), 1e-12);
  EXPECT_EQ(targetErrors({}).n, 0);
}

TEST(Verdict, AllowsForTheUncertaintyOfFewTouches) {
  // 16 touches: 1 + 1.65 / sqrt(96) = 1.168; 4 touches: 1.337.
  EXPECT_NEAR(assess(evenErrors(0.4), VerificationKind::full).rms_upper_bound_mm, 0.4 * 1.1684, 1e-4);
  EXPECT_EQ(assess(evenErrors(0.42), VerificationKind::full).verdict, Verdict::green);
  EXPECT_EQ(assess(evenErrors(0.44), VerificationKind::full).verdict, Verdict::amber);
  EXPECT_EQ(assess(evenErrors(0.84), VerificationKind::full).verdict, Verdict::amber);
  EXPECT_EQ(assess(evenErrors(0.87), VerificationKind::full).verdict, Verdict::red);
}

TEST(Verdict, HasWiderLimitsByEyeAndForASessionCheck) {
  EXPECT_EQ(assess(evenErrors(0.66), VerificationKind::by_eyes).verdict, Verdict::green);
  EXPECT_EQ(assess(evenErrors(1.3), VerificationKind::by_eyes).verdict, Verdict::red);
  // Opposite pairs: no bias.
  EXPECT_EQ(assess(evenErrors(0.44, 4), VerificationKind::session_check).verdict, Verdict::green);
  EXPECT_EQ(assess(evenErrors(0.5, 4), VerificationKind::session_check).verdict, Verdict::amber);
  EXPECT_EQ(assess(evenErrors(1.0, 4), VerificationKind::session_check).verdict, Verdict::red);
}

TEST(Verdict, IsDecidedByTheWorstQuantityAndNamesIt) {
  TargetErrors errors = evenErrors(0.2);
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::green);
  errors.max_mm = 1.3;
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::amber);
  EXPECT_THAT(assess(errors, VerificationKind::full).reason, HasSubstr("worst touch 1.30 mm off, more than 1.20 mm"));
  errors.p95_mm = 1.9;
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::red);
  EXPECT_THAT(assess(errors, VerificationKind::full).reason, HasSubstr("within 1.90 mm, more than 1.80 mm"));
  errors = evenErrors(0.2);
  errors.bias_mm.xyz.y = -0.4;
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::amber);
  EXPECT_THAT(assess(errors, VerificationKind::full).reason, HasSubstr("in one direction by 0.40 mm"));
}

TEST(Verdict, IsNeverGreenForFewerThanFourTouches) {
  EXPECT_EQ(assess(evenErrors(0.01, 3), VerificationKind::full).verdict, Verdict::amber);
  EXPECT_EQ(assess(evenErrors(0.01, 4), VerificationKind::full).verdict, Verdict::green);
  EXPECT_EQ(assess(evenErrors(5.0, 3), VerificationKind::full).verdict, Verdict::red);
  EXPECT_EQ(assess({}, VerificationKind::full).verdict, Verdict::red);
}

TEST(Verdict, IsRedForNan) {
  TargetErrors errors = evenErrors(0.1);
  errors.rms_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::red);
  errors = evenErrors(0.1);
  errors.bias_mm.xyz.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(assess(errors, VerificationKind::full).verdict, Verdict::red);
}

TEST(WorstError, IsDescribedAsTheSurgeonSeesIt) {
  std::vector<Residual> residuals;
  for (const double x : {-60.0, 0.0, 60.0})
    for (const double y : {-40.0, 0.0, 40.0})
      for (const double z : {-30.0, 0.0, 30.0}) residuals.push_back({1, {{x, y, z}}, {{0.1, 0, 0}}, true});
  const auto with = [&](const glm::dvec3& position, double size) {
    auto copy = residuals;
    for (Residual& r : copy)
      if (glm::distance(r.target_W.mm, position) < 1.0) r.error_mm = {{0.0, size, 0.0}};
    return worstErrorSentence(copy, {});
  };
  EXPECT_EQ(with({-60, -40, -30}, 0.92), "worst: back left low, 0.9 mm");
  EXPECT_EQ(with({60, 40, 30}, 1.5), "worst: front right high, 1.5 mm");
  EXPECT_EQ(with({0, 40, 0}, 0.5), "worst: high, 0.5 mm");
  EXPECT_EQ(with({0, 0, 0}, 0.5), "worst: in the middle, 0.5 mm");
  EXPECT_EQ(worstErrorSentence({}, {}), "no touches");
}

TEST(WorstError, IgnoresUnusedTouchesAndUnspannedAxes) {
  std::vector<Residual> flat = {{1, {{-50, 10, 0}}, {{9, 0, 0}}, false},
                                {2, {{50, 30, 0.1}}, {{0.3, 0, 0}}, true},
                                {3, {{-50, -30, -0.1}}, {{0.2, 0, 0}}, true}};
  EXPECT_EQ(worstErrorSentence(flat, {}), "worst: right high, 0.3 mm");
}

}  // namespace
}  // namespace calibration
