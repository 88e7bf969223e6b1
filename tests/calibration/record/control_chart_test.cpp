#include "calibration/record/control_chart.h"

#include <random>

#include <gtest/gtest.h>

namespace calibration {
namespace {

using enum ControlRule;

std::vector<ControlAlarm> of(std::vector<double> sigmas) { return controlAlarms(sigmas); }

void expectOne(const std::vector<ControlAlarm>& alarms, ControlRule rule, std::size_t at, bool above) {
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0].rule, rule);
  EXPECT_EQ(alarms[0].at, at);
  EXPECT_EQ(alarms[0].above, above);
}

TEST(ControlLimits, AreMeanAndMovingRange) {
  const std::vector<double> values = {1.0, 3.0, 2.0, 4.0};  // moves by 2, 1, 2
  const auto limits = controlLimits(values, 4, 0.0);
  ASSERT_TRUE(limits);
  EXPECT_DOUBLE_EQ(limits->centre, 2.5);
  EXPECT_DOUBLE_EQ(limits->sigma, 5.0 / 3.0 / 1.128);
  EXPECT_EQ(limits->n, 4u);
  EXPECT_FALSE(controlLimits(values, 5, 0.0));
  EXPECT_FALSE(controlLimits(std::span(values).first(1), 0, 0.0));
}

TEST(ControlLimits, AreNeverFinerThanTheResolution) {
  EXPECT_EQ(controlLimits(std::vector<double>(8, 0.3), 8, 0.02)->sigma, 0.02);
}

TEST(ControlLimits, FindTheSigmaOfNormalValues) {
  std::mt19937 rng(1);
  std::normal_distribution<double> normal(5.0, 0.7);
  std::vector<double> values(20000);
  for (double& v : values) v = normal(rng);
  EXPECT_NEAR(controlLimits(values, 8, 0.0)->sigma, 0.7, 0.01);
}

TEST(ControlAlarms, OneBeyondThreeSigma) {
  expectOne(of({0.5, -0.5, 3.01, 0.5}), one_beyond_3, 2, true);
  expectOne(of({0.5, -3.01}), one_beyond_3, 1, false);
  EXPECT_TRUE(of({0.5, 3.0, -0.5}).empty());
}

TEST(ControlAlarms, TwoOfThreeBeyondTwoSigma) {
  expectOne(of({0.1, 2.1, -0.1, 2.1, -0.1}), two_of_3_beyond_2, 3, true);
  expectOne(of({-2.1, -2.1}), two_of_3_beyond_2, 1, false);
  EXPECT_TRUE(of({2.1, -2.1, 0.1}).empty()) << "on two sides";
  EXPECT_TRUE(of({2.1, 0.1, -0.1, 2.1}).empty()) << "too far apart";
  EXPECT_TRUE(of({2.0, 2.0, -0.1}).empty()) << "at two, not beyond";
}

TEST(ControlAlarms, FourOfFiveBeyondOneSigma) {
  expectOne(of({1.1, 1.1, -0.1, 1.1, 1.1}), four_of_5_beyond_1, 4, true);
  expectOne(of({-1.1, -1.1, -1.1, -1.1, 0.1}), four_of_5_beyond_1, 3, false);
  EXPECT_TRUE(of({1.1, 1.1, -0.1, -0.1, 1.1, 1.1}).empty());
  EXPECT_TRUE(of({1.1, 1.1, -1.1, 1.1, 0.9}).empty()) << "the newest is not beyond";
}

TEST(ControlAlarms, EightOnOneSide) {
  expectOne(of({0.1, 0.2, 0.1, 0.3, 0.1, 0.2, 0.1, 0.1, -0.1}), eight_on_one_side, 7, true);
  expectOne(of({-0.1, -0.2, -0.1, -0.3, -0.1, -0.2, -0.1, -0.1}), eight_on_one_side, 7, false);
  EXPECT_TRUE(of({0.1, 0.2, 0.1, 0.3, 0.0, 0.2, 0.1, 0.1}).empty()) << "the centre is on no side";
  EXPECT_TRUE(of({0.1, 0.2, 0.1, 0.3, 0.1, 0.2, 0.1}).empty());
}

TEST(ControlAlarms, NameTheStrongestRule) {
  expectOne(of({2.5, 3.5}), one_beyond_3, 1, true);  // two of three as well
}

TEST(ControlAlarms, AreSeldomWhereNothingChanges) {
  std::mt19937 rng(2);
  std::normal_distribution<double> normal;
  std::vector<double> sigmas(20000);
  for (double& v : sigmas) v = normal(rng);
  // All four rules together: a false alarm in 91.75 values (Champ and Woodall 1987), runs counted once.
  std::size_t runs = 0;
  std::vector<double> since;
  for (const double v : sigmas) {
    since.push_back(v);
    if (controlAlarms(since).empty()) continue;
    ++runs;
    since.clear();
  }
  EXPECT_NEAR(20000.0 / static_cast<double>(runs), 91.75, 15.0);
}

}  // namespace
}  // namespace calibration
