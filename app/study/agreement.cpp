#include "app/study/agreement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <boost/math/distributions/fisher_f.hpp>

namespace app {
namespace {

constexpr double kUpperTail = 0.025;

/// Coincidences of every pair of values that one unit was given.
struct Coincidences {
  std::map<int, std::map<int, double>> together;
  std::map<int, double> total;
  double all = 0.0;

  void add(const std::vector<int>& values) {
    if (values.size() < 2) return;
    const double each = 1.0 / static_cast<double>(values.size() - 1);
    for (std::size_t a = 0; a < values.size(); ++a)
      for (std::size_t b = 0; b < values.size(); ++b)
        if (a != b) together[values[a]][values[b]] += each, total[values[a]] += each, all += each;
  }

  /// Squared distance of two values. Of ranks: what lies between them, with half of both ends.
  double apart(int a, int b, RatingScale scale) const {
    if (scale == RatingScale::nominal) return a == b ? 0.0 : 1.0;
    if (scale == RatingScale::interval) return std::pow(static_cast<double>(a) - b, 2);
    double between = -0.5 * (total.at(a) + total.at(b));
    for (auto one = total.lower_bound(std::min(a, b)); one != total.end() && one->first <= std::max(a, b); ++one)
      between += one->second;
    return std::pow(between, 2);
  }

  std::optional<double> alpha(RatingScale scale) const {
    if (total.size() < 2 || all < 2.0) return {};
    double observed = 0.0, expected = 0.0;
    for (const auto& [a, count_a] : total)
      for (const auto& [b, count_b] : total) {
        if (a == b) continue;
        const double distance = apart(a, b, scale);
        const auto& row = together.at(a);
        const auto pair = row.find(b);
        observed += (pair == row.end() ? 0.0 : pair->second) * distance;
        expected += count_a * count_b * distance;
      }
    if (expected <= 0.0) return {};
    return 1.0 - (all - 1.0) * observed / expected;
  }
};

/// Values of each unit that two raters or more rated.
std::vector<std::vector<int>> unitsOf(const Ratings& ratings) {
  std::vector<std::vector<int>> units;
  if (ratings.empty()) return units;
  for (std::size_t unit = 0; unit < ratings.front().size(); ++unit) {
    std::vector<int> values;
    for (const auto& rater : ratings)
      if (rater[unit]) values.push_back(*rater[unit]);
    if (values.size() >= 2) units.push_back(std::move(values));
  }
  return units;
}

/// Infinite where it is too large for a number.
double fQuantile(double first, double second) {
  using Infinite =
      boost::math::policies::policy<boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
  return boost::math::quantile(
      boost::math::complement(boost::math::fisher_f_distribution<double, Infinite>(first, second), kUpperTail));
}

std::optional<ValueRange> rangeWhereKnown(double low, double high) {
  return std::isfinite(low) && std::isfinite(high) ? std::optional(ValueRange{low, high}) : std::nullopt;
}

}  // namespace

std::optional<double> krippendorffAlpha(const Ratings& ratings, RatingScale scale) {
  Coincidences pairs;
  for (const std::vector<int>& unit : unitsOf(ratings)) pairs.add(unit);
  return pairs.alpha(scale);
}

std::optional<ValueRange> alphaInterval(const Ratings& ratings, RatingScale scale, std::uint64_t seed) {
  const std::vector<std::vector<int>> units = unitsOf(ratings);
  if (units.empty()) return {};
  std::mt19937_64 random(seed);
  std::vector<double> alphas;
  for (std::size_t sample = 0; sample < kAlphaSamples; ++sample) {
    Coincidences pairs;
    for (std::size_t n = 0; n < units.size(); ++n) pairs.add(units[random() % units.size()]);
    if (const auto alpha = pairs.alpha(scale)) alphas.push_back(*alpha);
  }
  if (alphas.size() < kAlphaSamples / 2) return {};
  std::ranges::sort(alphas);
  const auto left_out = static_cast<std::size_t>(kUpperTail * static_cast<double>(alphas.size()));
  return ValueRange{alphas[left_out], alphas[alphas.size() - 1 - left_out]};
}

std::optional<IntraclassCorrelation> intraclassCorrelation(const Ratings& ratings) {
  if (ratings.size() < 2 || ratings.front().size() < 2) return {};
  const auto raters = static_cast<double>(ratings.size()), targets = static_cast<double>(ratings.front().size());
  std::vector<double> of_rater(ratings.size(), 0.0), of_target(ratings.front().size(), 0.0);
  double mean = 0.0;
  for (std::size_t j = 0; j < ratings.size(); ++j)
    for (std::size_t i = 0; i < of_target.size(); ++i) {
      if (!ratings[j][i]) return {};
      of_rater[j] += *ratings[j][i] / targets, of_target[i] += *ratings[j][i] / raters;
      mean += *ratings[j][i] / (targets * raters);
    }
  double between = 0.0, judges = 0.0, rest = 0.0;
  for (const double one : of_target) between += raters * std::pow(one - mean, 2) / (targets - 1.0);
  for (const double one : of_rater) judges += targets * std::pow(one - mean, 2) / (raters - 1.0);
  const double freedom = (targets - 1.0) * (raters - 1.0);
  for (std::size_t j = 0; j < ratings.size(); ++j)
    for (std::size_t i = 0; i < of_target.size(); ++i)
      rest += std::pow(*ratings[j][i] - of_rater[j] - of_target[i] + mean, 2) / freedom;

  constexpr double kNothing = 1e-12;
  const double below_3 = between + (raters - 1.0) * rest, below_2 = below_3 + raters * (judges - rest) / targets;
  if (below_3 < kNothing || below_2 < kNothing) return {};
  IntraclassCorrelation made{(between - rest) / below_2, (between - rest) / below_3, {}, {}};
  if (rest < kNothing) return made;
  const double f = between / rest, low = f / fQuantile(targets - 1.0, freedom),
               high = f * fQuantile(freedom, targets - 1.0);
  made.consistency_interval = rangeWhereKnown((low - 1.0) / (low + raters - 1.0), (high - 1.0) / (high + raters - 1.0));
  // Shrout and Fleiss 1979, p. 424: degrees of freedom by Satterthwaite.
  const double rho = made.agreement, of_judges = judges / rest;
  const double a = raters * rho * of_judges, b = targets * (1.0 + (raters - 1.0) * rho) - raters * rho;
  const double v = freedom * std::pow(a + b, 2) / ((targets - 1.0) * a * a + b * b);
  if (!(v > 0.0)) return made;
  const double upper_f = fQuantile(targets - 1.0, v), lower_f = fQuantile(v, targets - 1.0);
  const double others = raters * judges + (raters * targets - raters - targets) * rest;
  made.agreement_interval =
      rangeWhereKnown(targets * (between - upper_f * rest) / (upper_f * others + targets * between),
                      targets * (lower_f * between - rest) / (others + targets * lower_f * between));
  return made;
}

}  // namespace app
