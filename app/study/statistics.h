// The statistics of a small study: summaries, intervals, rank tests that are exact with ties, and
// how many problems are still to be found. Distributions by Boost.Math; the rest is counted here. Nothing is told of
// too few values: an absent result says so. Pure; any thread; a rank test of 60 values takes 20 ms.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace app {

struct ValueRange {
  double low = 0.0, high = 0.0;
};

struct Summary {
  std::size_t count = 0;
  std::optional<double> mean, median, low, high;
  std::optional<double> deviation;  ///< with n - 1; none below two values
};
Summary summaryOf(std::span<const double> values);

/// At 95 %. Student's t; none below two values.
std::optional<ValueRange> meanInterval(std::span<const double> values);
/// By order statistics: the narrowest symmetric pair that covers 95 % (Conover 1999, 3.2); none below six values.
std::optional<ValueRange> medianInterval(std::span<const double> values);
/// Adjusted Wald (Agresti and Coull 1998) within 0..1; none of none.
std::optional<ValueRange> shareInterval(std::size_t successes, std::size_t count);
/// Of times: geometric mean, and its interval by t on the logarithm. All must be positive.
std::optional<double> geometricMean(std::span<const double> values);
std::optional<ValueRange> geometricMeanInterval(std::span<const double> values);

struct RankTest {
  double p = 1.0;              ///< two-sided: as far from the expectation as seen, or farther
  bool is_exact = true;        ///< by counting all arrangements; else normal, with ties
  double shift = 0.0;          ///< Hodges and Lehmann's
  double rank_biserial = 0.0;  ///< -1..1
  std::size_t left_out = 0;    ///< pairs without a difference
  /// Of the shift, at 95 % or more, by order statistics (Hollander and Wolfe 1999, 3.3 and 4.3), which ties only widen;
  /// none below six pairs, or where two groups are as small.
  std::optional<ValueRange> shift_interval = {};
};
/// Wilcoxon's signed ranks of differences; zeros are left out. None where no difference is left.
std::optional<RankTest> signedRankTest(std::span<const double> differences);
/// Mann and Whitney's: `shift` of the second against the first. None where either is empty.
std::optional<RankTest> rankSumTest(std::span<const double> first, std::span<const double> second);

/// Holm 1979: adjusted p values in the order given.
std::vector<double> holmAdjusted(std::vector<double> p);

/// How well problems were found by `participants` people (Nielsen and Landauer 1993), with the chance to meet one
/// corrected for few people (Lewis 2001).
struct Discovery {
  double chance = 0.0;        ///< corrected, of one person to meet one problem
  double found_share = 0.0;   ///< of all problems there are
  std::size_t needed_85 = 0;  ///< people to find 85 %
};
/// `met_by`: how many people met each problem. None below four people, or without problems.
std::optional<Discovery> discoveryOf(std::span<const std::size_t> met_by, std::size_t participants);

}  // namespace app
