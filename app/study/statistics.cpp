#include "app/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace app {
namespace {

constexpr double kTail = 0.025;  // of a two-sided interval at 95 %
constexpr std::size_t kMostCounted = 60;

double meanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double medianOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<double> logarithmsOf(std::span<const double> values) {
  std::vector<double> logarithms;
  for (const double value : values)
    if (value > 0.0) logarithms.push_back(std::log(value));
  return logarithms;
}

/// Twice the mid-ranks: whole numbers, also where values are equal, to a part in 10^9 of an answer's step.
std::vector<std::int64_t> doubledRanks(std::vector<double> values) {
  constexpr double kSame = 1e-9;
  for (double& value : values) value = std::round(value / kSame);
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) { return values[n]; });
  std::vector<std::int64_t> ranks(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    for (std::size_t n = from; n < to; ++n) ranks[order[n]] = static_cast<std::int64_t>(from + to + 1);
    from = to;
  }
  return ranks;
}

/// Two-sided p of a sum among all, of which ways[sum] are known.
double shareAsFar(const std::vector<double>& ways, std::int64_t doubled_expectation, std::int64_t sum) {
  const std::int64_t seen = std::abs(2 * sum - doubled_expectation);
  double as_far = 0.0, all = 0.0;
  for (std::size_t at = 0; at < ways.size(); ++at) {
    all += ways[at];
    if (std::abs(2 * static_cast<std::int64_t>(at) - doubled_expectation) >= seen) as_far += ways[at];
  }
  return as_far / all;
}

double normalTwoSided(double distance, double variance) {
  if (variance <= 0.0) return 1.0;
  return 2.0 *
         boost::math::cdf(boost::math::complement(boost::math::normal(), std::abs(distance) / std::sqrt(variance)));
}

/// Ways to each sum of `chosen` (any number where it is none) of the ranks 1..count.
std::vector<double> waysOfRanks(std::size_t count, std::optional<std::size_t> chosen) {
  const std::size_t width = count * (count + 1) / 2 + 1, rows = chosen.value_or(0) + 1;
  std::vector<std::vector<double>> ways(rows, std::vector<double>(width, 0.0));
  ways[0][0] = 1.0;
  for (std::size_t rank = 1; rank <= count; ++rank)
    for (std::size_t row = rows; row-- > (chosen ? 1U : 0U);)
      for (std::size_t sum = width; sum-- > rank;) ways[row][sum] += ways[chosen ? row - 1 : row][sum - rank];
  return ways.back();
}

/// From the k-th smallest to the k-th largest, of as large a k as leaves 2.5 % at each end; `lowest`: the sum of the
/// first of `ways` that there is.
std::optional<ValueRange> orderInterval(std::vector<double> values, const std::vector<double>& ways,
                                        std::size_t lowest) {
  const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
  std::size_t k = 0;
  for (double below = 0.0; 2 * (k + 1) <= values.size() && lowest + k < ways.size(); ++k) {
    below += ways[lowest + k];
    if (below > kTail * all) break;
  }
  if (k == 0) return {};
  std::ranges::sort(values);
  return ValueRange{values[k - 1], values[values.size() - k]};
}

/// The same by the normal distribution.
std::optional<ValueRange> orderInterval(std::vector<double> values, double variance) {
  const double z = boost::math::quantile(boost::math::complement(boost::math::normal(), kTail));
  const double place = std::floor(0.5 * static_cast<double>(values.size()) - z * std::sqrt(variance));
  if (place < 1.0) return {};
  const auto k = static_cast<std::size_t>(place);
  std::ranges::sort(values);
  return ValueRange{values[k - 1], values[values.size() - k]};
}

}  // namespace

Summary summaryOf(std::span<const double> values) {
  Summary made;
  made.count = values.size();
  if (values.empty()) return made;
  const double mean = meanOf(values);
  made.mean = mean;
  made.median = medianOf({values.begin(), values.end()});
  const auto [low, high] = std::ranges::minmax_element(values);
  made.low = *low, made.high = *high;
  if (values.size() < 2) return made;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  made.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return made;
}

std::optional<ValueRange> meanInterval(std::span<const double> values) {
  const Summary summary = summaryOf(values);
  if (!summary.deviation) return {};
  const auto count = static_cast<double>(values.size());
  const double t = boost::math::quantile(boost::math::complement(boost::math::students_t(count - 1.0), kTail));
  const double half = t * *summary.deviation / std::sqrt(count);
  return ValueRange{*summary.mean - half, *summary.mean + half};
}

std::optional<ValueRange> medianInterval(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const boost::math::binomial halves(static_cast<double>(sorted.size()), 0.5);
  std::size_t left = 0;  // values that may be left out at each end
  while (2 * (left + 1) < sorted.size() && boost::math::cdf(halves, static_cast<double>(left)) <= kTail) ++left;
  if (left == 0) return {};
  return ValueRange{sorted[left - 1], sorted[sorted.size() - left]};
}

std::optional<ValueRange> shareInterval(std::size_t successes, std::size_t count) {
  if (count == 0) return {};
  const double z = boost::math::quantile(boost::math::complement(boost::math::normal(), kTail));
  const double all = static_cast<double>(count) + z * z;
  const double share = (static_cast<double>(successes) + 0.5 * z * z) / all;
  const double half = z * std::sqrt(share * (1.0 - share) / all);
  return ValueRange{std::max(0.0, share - half), std::min(1.0, share + half)};
}

std::optional<double> geometricMean(std::span<const double> values) {
  const std::vector<double> logarithms = logarithmsOf(values);
  if (logarithms.empty() || logarithms.size() != values.size()) return {};
  return std::exp(meanOf(logarithms));
}

std::optional<ValueRange> geometricMeanInterval(std::span<const double> values) {
  const std::vector<double> logarithms = logarithmsOf(values);
  const auto range = logarithms.size() == values.size() ? meanInterval(logarithms) : std::nullopt;
  if (!range) return {};
  return ValueRange{std::exp(range->low), std::exp(range->high)};
}

std::optional<RankTest> signedRankTest(std::span<const double> differences) {
  std::vector<double> kept, sizes;
  for (const double difference : differences)
    if (difference != 0.0) kept.push_back(difference), sizes.push_back(std::abs(difference));
  if (kept.empty()) return {};
  const std::vector<std::int64_t> ranks = doubledRanks(sizes);
  const std::int64_t all = std::accumulate(ranks.begin(), ranks.end(), std::int64_t{0});
  std::int64_t positive = 0;
  for (std::size_t n = 0; n < kept.size(); ++n) positive += kept[n] > 0.0 ? ranks[n] : 0;

  RankTest test;
  test.left_out = differences.size() - kept.size();
  test.is_exact = kept.size() <= kMostCounted;
  if (test.is_exact) {
    // Each rank is in the sum or not.
    std::vector<double> ways(static_cast<std::size_t>(all) + 1, 0.0);
    ways[0] = 1.0;
    for (const std::int64_t rank : ranks)
      for (std::int64_t sum = all; sum >= rank; --sum)
        ways[static_cast<std::size_t>(sum)] += ways[static_cast<std::size_t>(sum - rank)];
    test.p = shareAsFar(ways, all, positive);
  } else {
    double variance = 0.0;
    for (const std::int64_t rank : ranks) variance += 0.25 * static_cast<double>(rank * rank);
    test.p = normalTwoSided(static_cast<double>(positive) - 0.5 * static_cast<double>(all), variance);
  }
  test.rank_biserial = (2.0 * static_cast<double>(positive) - static_cast<double>(all)) / static_cast<double>(all);
  std::vector<double> means;
  for (std::size_t a = 0; a < differences.size(); ++a)
    for (std::size_t b = a; b < differences.size(); ++b) means.push_back(0.5 * (differences[a] + differences[b]));
  const auto count = differences.size();
  const auto n = static_cast<double>(count);
  test.shift_interval = count <= kMostCounted ? orderInterval(means, waysOfRanks(count, {}), 0)
                                              : orderInterval(means, n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
  test.shift = medianOf(std::move(means));
  return test;
}

std::optional<RankTest> rankSumTest(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty()) return {};
  std::vector<double> both(first.begin(), first.end());
  both.insert(both.end(), second.begin(), second.end());
  const std::vector<std::int64_t> ranks = doubledRanks(both);
  const auto all_count = static_cast<std::int64_t>(both.size()), count = static_cast<std::int64_t>(second.size());
  const std::int64_t seen =
      std::accumulate(ranks.begin() + static_cast<std::ptrdiff_t>(first.size()), ranks.end(), std::int64_t{0});
  // Doubled ranks have the mean all_count + 1.
  const std::int64_t expectation = count * (all_count + 1);

  RankTest test;
  test.is_exact = both.size() <= kMostCounted;
  if (test.is_exact) {
    const std::int64_t most = std::accumulate(ranks.begin(), ranks.end(), std::int64_t{0});
    const auto width = static_cast<std::size_t>(most) + 1;
    // ways[k]: of choosing k of the values with each sum.
    std::vector<std::vector<double>> ways(static_cast<std::size_t>(count) + 1, std::vector<double>(width, 0.0));
    ways[0][0] = 1.0;
    for (const std::int64_t rank : ranks)
      for (std::size_t k = ways.size() - 1; k >= 1; --k)
        for (std::size_t sum = width - 1; sum >= static_cast<std::size_t>(rank); --sum)
          ways[k][sum] += ways[k - 1][sum - static_cast<std::size_t>(rank)];
    test.p = shareAsFar(ways.back(), 2 * expectation, seen);
  } else {
    double squares = 0.0;
    for (const std::int64_t rank : ranks) squares += std::pow(static_cast<double>(rank - (all_count + 1)), 2);
    const auto n = static_cast<double>(all_count);
    const double variance = static_cast<double>(count) * (n - static_cast<double>(count)) / (n * (n - 1.0)) * squares;
    test.p = normalTwoSided(static_cast<double>(seen - expectation), variance);
  }
  double above = 0.0;
  std::vector<double> differences;
  for (const double a : first)
    for (const double b : second) {
      differences.push_back(b - a);
      above += b > a ? 1.0 : b < a ? -1.0 : 0.0;
    }
  test.rank_biserial = above / static_cast<double>(differences.size());
  const std::size_t second_count = second.size(), both_count = both.size();
  test.shift_interval =
      test.is_exact
          ? orderInterval(differences, waysOfRanks(both_count, second_count), second_count * (second_count + 1) / 2)
          : orderInterval(differences, static_cast<double>(first.size() * second_count * (both_count + 1)) / 12.0);
  test.shift = medianOf(std::move(differences));
  return test;
}

std::vector<double> holmAdjusted(std::vector<double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t n) { return p[n]; });
  double so_far = 0.0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    so_far = std::max(so_far, std::min(1.0, static_cast<double>(order.size() - n) * p[order[n]]));
    p[order[n]] = so_far;
  }
  return p;
}

std::optional<Discovery> discoveryOf(std::span<const std::size_t> met_by, std::size_t participants) {
  constexpr std::size_t kFewest = 4;
  if (met_by.empty() || participants < kFewest) return {};
  const auto people = static_cast<double>(participants), problems = static_cast<double>(met_by.size());
  const double met = static_cast<double>(std::accumulate(met_by.begin(), met_by.end(), std::size_t{0}));
  const double raw = met / (people * problems);
  // Good-Turing: problems that one person alone met tell of those that nobody did.
  const double once = static_cast<double>(std::ranges::count(met_by, std::size_t{1})) / problems;
  Discovery made;
  made.chance = std::clamp(0.5 * (raw - 1.0 / people) * (1.0 - 1.0 / people) + 0.5 * raw / (1.0 + once), 0.0, 1.0);
  made.found_share = 1.0 - std::pow(1.0 - made.chance, people);
  if (made.chance <= 0.0) return {};
  constexpr double kWanted = 0.85;
  constexpr std::size_t kMostPeople = 10'000;
  while (made.needed_85 < kMostPeople &&
         1.0 - std::pow(1.0 - made.chance, static_cast<double>(made.needed_85)) < kWanted)
    ++made.needed_85;
  return made;
}

}  // namespace app
