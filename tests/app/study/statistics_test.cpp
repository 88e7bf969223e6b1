#include "app/study/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace app {
namespace {

using Values = std::vector<double>;

TEST(Statistics, SummaryOfAFewAnswersByHand) {
  const Summary summary = summaryOf(Values{6, 6, 6, 6, 6, 6, 5, 5, 5, 5});
  EXPECT_EQ(summary.count, 10u);
  EXPECT_NEAR(*summary.mean, 5.6, 1e-12);
  EXPECT_NEAR(*summary.deviation, 0.5163977794943222, 1e-12);
  EXPECT_EQ(*summary.median, 6.0);
  EXPECT_EQ(*summary.low, 5.0);
  EXPECT_EQ(*summary.high, 6.0);
  EXPECT_EQ(*summaryOf(Values{1, 2, 4, 8}).median, 3.0);
}

TEST(Statistics, SaysNothingOfTooFew) {
  EXPECT_FALSE(summaryOf({}).mean);
  EXPECT_FALSE(summaryOf(Values{3}).deviation);
  EXPECT_FALSE(meanInterval(Values{3}));
  EXPECT_FALSE(medianInterval(Values{1, 2, 3, 4, 5})) << "2 * 0.5^5 is more than 5 %";
  EXPECT_TRUE(medianInterval(Values{1, 2, 3, 4, 5, 6}));
  EXPECT_FALSE(shareInterval(0, 0));
  EXPECT_FALSE(geometricMean(Values{1.0, 0.0}));
  EXPECT_FALSE(signedRankTest(Values{0.0, 0.0}));
  EXPECT_FALSE(rankSumTest({}, Values{1.0}));
  EXPECT_FALSE(discoveryOf(std::array<std::size_t, 2>{1, 2}, 3));
}

TEST(Statistics, IntervalsOfTextbooks) {
  // t of 9 degrees of freedom is 2.262157.
  const Values values{6, 6, 6, 6, 6, 6, 5, 5, 5, 5};
  const auto mean = meanInterval(values);
  EXPECT_NEAR(mean->high - 5.6, 2.2621571628 * 0.5163977795 / std::sqrt(10.0), 1e-9);
  // Ten values: from the second to the ninth, which covers 97.9 %.
  const auto median = medianInterval(Values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  EXPECT_EQ(median->low, 2.0);
  EXPECT_EQ(median->high, 9.0);
  // Agresti and Coull: (x + z²/2) / (n + z²).
  const auto share = shareInterval(9, 10);
  EXPECT_NEAR(0.5 * (share->low + 1.0), 0.5 * (0.5740 + 1.0), 1e-3);
  EXPECT_EQ(share->high, 1.0);
  const auto times = geometricMeanInterval(Values{10.0, 1000.0});
  EXPECT_NEAR(*geometricMean(Values{10.0, 1000.0}), 100.0, 1e-9);
  EXPECT_NEAR(std::sqrt(times->low * times->high), 100.0, 1e-9);
}

/// Slow and obvious: every choice of signs.
double signedRankTwin(const Values& differences) {
  Values kept;
  for (const double d : differences)
    if (d != 0.0) kept.push_back(d);
  Values ranks;
  for (const double d : kept) {
    double below = 0, same = 0;
    for (const double other : kept) below += std::abs(other) < std::abs(d), same += std::abs(other) == std::abs(d);
    ranks.push_back(below + 0.5 * (same + 1.0));
  }
  const double all = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  double seen = 0;
  for (std::size_t n = 0; n < kept.size(); ++n) seen += kept[n] > 0 ? ranks[n] : 0;
  int as_far = 0;
  for (unsigned signs = 0; signs < (1U << kept.size()); ++signs) {
    double sum = 0;
    for (std::size_t n = 0; n < kept.size(); ++n) sum += (signs >> n & 1U) != 0 ? ranks[n] : 0;
    as_far += std::abs(sum - 0.5 * all) >= std::abs(seen - 0.5 * all) - 1e-9;
  }
  return as_far / std::pow(2.0, static_cast<double>(kept.size()));
}

/// The same for two groups: every choice of which values are the second group's.
double rankSumTwin(const Values& first, const Values& second) {
  Values both = first;
  both.insert(both.end(), second.begin(), second.end());
  Values ranks;
  for (const double v : both) {
    double below = 0, same = 0;
    for (const double other : both) below += other < v, same += other == v;
    ranks.push_back(below + 0.5 * (same + 1.0));
  }
  const double expected = 0.5 * static_cast<double>(second.size() * (both.size() + 1));
  const double seen =
      std::accumulate(ranks.begin() + static_cast<std::ptrdiff_t>(first.size()), ranks.end(), 0.0) - expected;
  int as_far = 0, all = 0;
  for (unsigned chosen = 0; chosen < (1U << both.size()); ++chosen) {
    if (static_cast<std::size_t>(__builtin_popcount(chosen)) != second.size()) continue;
    double sum = -expected;
    for (std::size_t n = 0; n < both.size(); ++n) sum += (chosen >> n & 1U) != 0 ? ranks[n] : 0;
    as_far += std::abs(sum) >= std::abs(seen) - 1e-9;
    ++all;
  }
  return static_cast<double>(as_far) / all;
}

TEST(Statistics, RankTestsCountAllArrangementsTiesIncluded) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> answer(1, 7), count(1, 7);
  for (int round = 0; round < 60; ++round) {
    Values first, second, differences;
    for (int n = count(random); n > 0; --n) first.push_back(answer(random));
    for (int n = count(random); n > 0; --n) second.push_back(answer(random));
    for (int n = count(random) + 3; n > 0; --n) differences.push_back(answer(random) - answer(random));
    EXPECT_NEAR(rankSumTest(first, second)->p, rankSumTwin(first, second), 1e-12);
    if (const auto test = signedRankTest(differences)) {
      EXPECT_NEAR(test->p, signedRankTwin(differences), 1e-12);
    }
  }
}

TEST(Statistics, ShiftsAreHodgesAndLehmanns) {
  const Values first{1, 2, 3, 4, 5}, second{3, 4, 5, 6, 7};
  const auto apart = rankSumTest(first, second);
  EXPECT_EQ(apart->shift, 2.0);
  EXPECT_NEAR(rankSumTest(second, first)->shift, -2.0, 0.0);
  EXPECT_NEAR(apart->rank_biserial, (19.0 - 3.0) / 25.0, 1e-12);
  EXPECT_EQ(rankSumTest(Values{1, 2, 3}, Values{7, 8, 9})->rank_biserial, 1.0);
  const auto paired = signedRankTest(Values{1, 1, 2, 3, 0});
  EXPECT_EQ(paired->left_out, 1u);
  EXPECT_EQ(paired->rank_biserial, 1.0);
  EXPECT_EQ(paired->shift, 1.5) << "the eighth of 15 means of two";
  // Means of items are not exact in binary: two thirds and its double's half are one value.
  EXPECT_EQ(signedRankTest(Values{2.0 / 3.0, -(5.0 / 3.0 - 1.0)})->p, 1.0);
}

TEST(Statistics, ManyValuesByTheNormalDistribution) {
  Values first, second;
  for (int n = 0; n < 40; ++n) first.push_back(n), second.push_back(n + 10.5);
  const auto test = rankSumTest(first, second);
  EXPECT_FALSE(test->is_exact);
  // U = 40 * 40 - pairs in which the first is larger; z = (U - 800) / sqrt(800 * 81 / 6).
  double larger = 0;
  for (const double a : first)
    for (const double b : second) larger += a > b;
  const double z = (800.0 - larger) / std::sqrt(800.0 * 81.0 / 6.0);
  EXPECT_NEAR(test->p, std::erfc(z / std::sqrt(2.0)), 1e-9);
}

TEST(Statistics, HolmStepsDown) {
  const std::vector<double> p = holmAdjusted({0.01, 0.04, 0.03, 0.005});
  EXPECT_NEAR(p[3], 0.02, 1e-12);
  EXPECT_NEAR(p[0], 0.03, 1e-12);
  EXPECT_NEAR(p[2], 0.06, 1e-12);
  EXPECT_NEAR(p[1], 0.06, 1e-12) << "never below one before it";
  EXPECT_TRUE(holmAdjusted({}).empty());
}

// Krippendorff, Computing Krippendorff's alpha-reliability (2011): four observers, twelve units, ordinal 0.815.
// The interval is what a two-sided test at 5 % does not refuse.
TEST(Statistics, TheIntervalOfAShiftIsWhereTheTestTurns) {
  std::mt19937 random(11);
  std::normal_distribution<double> value(0.0, 3.0);
  constexpr double kStep = 1e-7, kLimit = 0.05;
  for (int round = 0; round < 30; ++round) {
    Values first, second, differences;
    for (int n = 0; n < 6 + round % 5; ++n) first.push_back(value(random)), differences.push_back(value(random));
    for (int n = 0; n < 5 + round % 4; ++n) second.push_back(value(random) + 1.0);
    const auto less = [](Values values, double by) {
      for (double& one : values) one -= by;
      return values;
    };
    const auto paired = signedRankTest(differences)->shift_interval;
    ASSERT_TRUE(paired);
    EXPECT_LE(signedRankTest(less(differences, paired->low - kStep))->p, kLimit);
    EXPECT_GT(signedRankTest(less(differences, paired->low + kStep))->p, kLimit);
    EXPECT_LE(signedRankTest(less(differences, paired->high + kStep))->p, kLimit);
    EXPECT_GT(signedRankTest(less(differences, paired->high - kStep))->p, kLimit);
    const auto apart = rankSumTest(first, second)->shift_interval;
    ASSERT_TRUE(apart);
    EXPECT_LE(rankSumTest(first, less(second, apart->low - kStep))->p, kLimit);
    EXPECT_GT(rankSumTest(first, less(second, apart->low + kStep))->p, kLimit);
    EXPECT_LE(rankSumTest(first, less(second, apart->high + kStep))->p, kLimit);
    EXPECT_GT(rankSumTest(first, less(second, apart->high - kStep))->p, kLimit);
  }
}

TEST(Statistics, TheIntervalOfAShiftByHand) {
  // Six pairs: 2 / 64 is less than 5 %, so from the smallest mean of two to the largest.
  const auto six = signedRankTest(Values{1, 2, 3, 4, 5, 7});
  EXPECT_EQ(six->shift_interval->low, 1.0);
  EXPECT_EQ(six->shift_interval->high, 7.0);
  EXPECT_FALSE(signedRankTest(Values{1, 2, 3, 4, 5})->shift_interval) << "2 / 32 is more";
  // Four and four: 2 / 70; three and three: 2 / 20.
  const auto four = rankSumTest(Values{1, 2, 3, 4}, Values{11, 12, 13, 14});
  EXPECT_EQ(four->shift_interval->low, 7.0);
  EXPECT_EQ(four->shift_interval->high, 13.0);
  EXPECT_FALSE(rankSumTest(Values{1, 2, 3}, Values{7, 8, 9})->shift_interval);
  // By the normal distribution: 70 pairs, k = 1242.5 - 1.96 sqrt(70 * 71 * 141 / 24), the 907th of 2485 means.
  Values many;
  for (int n = 1; n <= 70; ++n) many.push_back(n);
  const auto normal = signedRankTest(many)->shift_interval;
  EXPECT_NEAR(normal->low + normal->high, 71.0, 1e-9);
  EXPECT_NEAR(normal->high - normal->low, 10.0, 3.0);
}

// Lewis 2001's correction: four people, chance 0.5, three of ten problems met by one person alone.
TEST(Statistics, ProblemsStillToBeFound) {
  const std::array<std::size_t, 10> met_by{1, 1, 1, 2, 2, 2, 2, 3, 3, 3};
  const auto found = discoveryOf(met_by, 4);
  EXPECT_NEAR(found->chance, 0.2861, 1e-4);
  EXPECT_NEAR(found->found_share, 0.74, 5e-3);
  EXPECT_EQ(found->needed_85, 6u);
}

}  // namespace
}  // namespace app
