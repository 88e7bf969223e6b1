#include "app/psychophysics/psychometric_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/random.h"

namespace app {
namespace {

constexpr double kLargestLapse = 0.06;
constexpr double kJndPerSigma = 0.6744897501960817;  ///< Phi^-1(3/4)
/// Limits of sigma as multiples of the range of levels; outside, the levels cannot resolve the slope.
constexpr double kSteepest = 1e-3, kFlattest = 50.0;

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

double logLikelihood(const std::vector<LevelCount>& counts, const Psychometric& f) {
  double sum = 0.0;
  for (const LevelCount& c : counts) {
    const double p = std::clamp(f.probability(c.level), 1e-12, 1.0 - 1e-12);
    sum += c.harder * std::log(p) + (c.trials - c.harder) * std::log1p(-p);
  }
  return sum;
}

/// Log likelihood of the saturated model: every level has its observed share.
double saturated(const std::vector<LevelCount>& counts) {
  double sum = 0.0;
  for (const LevelCount& c : counts) {
    if (c.harder > 0) sum += c.harder * std::log(static_cast<double>(c.harder) / c.trials);
    if (c.harder < c.trials) sum += (c.trials - c.harder) * std::log1p(-static_cast<double>(c.harder) / c.trials);
  }
  return sum;
}

/// Fisher scoring of a + b u with step halving, u the level over the range of levels, for one lapse.
struct Line {
  double a = 0.0, b = 1.0;
};

class Scoring {
 public:
  Scoring(const std::vector<LevelCount>& counts, double centre, double range)
      : counts_(counts), centre_(centre), range_(range) {}

  Psychometric functionOf(const Line& line, double lapse) const {
    return {centre_ - range_ * line.a / line.b, range_ / line.b, lapse};
  }

  Psychometric fit(double lapse) const {
    Line line{0.0, 2.0};
    double value = logLikelihood(counts_, functionOf(line, lapse));
    for (int turn = 0; turn < 60; ++turn) {
      const Line step = scoringStep(line, lapse);
      double length = 1.0, gain = 0.0;
      for (; length > 1e-6; length *= 0.5) {
        const Line tried{line.a + length * step.a,
                         std::clamp(line.b + length * step.b, 1.0 / kFlattest, 1.0 / kSteepest)};
        gain = logLikelihood(counts_, functionOf(tried, lapse)) - value;
        if (gain <= 0.0) continue;
        line = tried;
        value += gain;
        break;
      }
      if (gain <= 1e-10) break;
    }
    return functionOf(line, lapse);
  }

 private:
  Line scoringStep(const Line& line, double lapse) const {
    double i_aa = 1e-9, i_ab = 0.0, i_bb = 1e-9, g_a = 0.0, g_b = 0.0;
    for (const LevelCount& c : counts_) {
      const double u = (c.level - centre_) / range_, z = line.a + line.b * u;
      const double p = std::clamp(lapse + (1.0 - 2.0 * lapse) * normalCdf(z), 1e-12, 1.0 - 1e-12);
      const double slope = (1.0 - 2.0 * lapse) * density(z), spread = p * (1.0 - p);
      const double score = slope * (c.harder - c.trials * p) / spread;
      const double weight = c.trials * slope * slope / spread;
      g_a += score, g_b += score * u;
      i_aa += weight, i_ab += weight * u, i_bb += weight * u * u;
    }
    const double determinant = std::max(i_aa * i_bb - i_ab * i_ab, 1e-18);
    return {(i_bb * g_a - i_ab * g_b) / determinant, (i_aa * g_b - i_ab * g_a) / determinant};
  }

  const std::vector<LevelCount>& counts_;
  double centre_, range_;
};

/// Whether the answers rise with the level: the sign of their covariance.
bool rises(const std::vector<LevelCount>& counts) {
  double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xy = 0.0;
  for (const LevelCount& c : counts) {
    n += c.trials, sum_x += c.trials * c.level, sum_y += c.harder, sum_xy += c.harder * c.level;
  }
  return n > 0.0 && sum_xy - sum_x * sum_y / n > 0.0;
}

Interval percentiles95(std::vector<double>& draws) {
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(draws.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, draws.size() - 1);
    return std::lerp(draws[low], draws[high], place - static_cast<double>(low));
  };
  return {at(0.025), at(0.975)};
}

}  // namespace

double normalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normalQuantile(double p) {
  // Bisection of Phi: slow, but exact to the last digits.
  double low = -40.0, high = 40.0;
  for (int i = 0; i < 90; ++i) {
    const double middle = 0.5 * (low + high);
    (normalCdf(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double Psychometric::probability(double level) const {
  return lapse + (1.0 - 2.0 * lapse) * normalCdf((level - pse) / sigma);
}
double Psychometric::jnd() const { return kJndPerSigma * sigma; }

std::optional<Psychometric> fitPsychometric(const std::vector<LevelCount>& counts, std::optional<double> fixed_lapse) {
  if (counts.size() < 2 || !rises(counts)) return std::nullopt;
  const auto [least, most] = std::minmax_element(
      counts.begin(), counts.end(), [](const LevelCount& a, const LevelCount& b) { return a.level < b.level; });
  const double range = most->level - least->level;
  if (!(range > 0.0)) return std::nullopt;
  const Scoring scoring(counts, 0.5 * (least->level + most->level), range);
  if (fixed_lapse) return scoring.fit(*fixed_lapse);

  // The likelihood over the lapse has one maximum in practice: golden section, and both ends.
  const auto likelihood_at = [&](double lapse) { return logLikelihood(counts, scoring.fit(lapse)); };
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0, high = kLargestLapse;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = likelihood_at(left), at_right = likelihood_at(right);
  while (high - low > 1e-3) {
    if (at_left >= at_right) {
      high = right, right = left, at_right = at_left;
      left = high - kGolden * (high - low), at_left = likelihood_at(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + kGolden * (high - low), at_right = likelihood_at(right);
    }
  }
  Psychometric best = scoring.fit(0.5 * (low + high));
  for (const double end : {0.0, kLargestLapse}) {
    const Psychometric other = scoring.fit(end);
    if (logLikelihood(counts, other) >= logLikelihood(counts, best)) best = other;
  }
  return best;
}

std::optional<PsychometricFit> fitWithIntervals(const std::vector<LevelCount>& counts, int draws, std::uint64_t seed,
                                                std::optional<double> fixed_lapse) {
  const std::optional<Psychometric> function = fitPsychometric(counts, fixed_lapse);
  if (!function) return std::nullopt;
  PsychometricFit fit;
  fit.function = *function;
  fit.log_likelihood = logLikelihood(counts, *function);
  fit.deviance = 2.0 * (saturated(counts) - fit.log_likelihood);

  // The same levels and trials with the fitted observer.
  calibration::RandomGenerator rng(seed, 0xb007);
  std::vector<double> pse, jnd;
  int worse = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<LevelCount> drawn = counts;
    for (LevelCount& c : drawn) {
      const double p = function->probability(c.level);
      c.harder = 0;
      for (int i = 0; i < c.trials; ++i) c.harder += rng.coin(p) ? 1 : 0;
    }
    const std::optional<Psychometric> again = fitPsychometric(drawn, fixed_lapse);
    if (!again) continue;
    pse.push_back(again->pse), jnd.push_back(again->jnd());
    if (2.0 * (saturated(drawn) - logLikelihood(drawn, *again)) >= fit.deviance) ++worse;
  }
  fit.draws = static_cast<int>(pse.size());
  if (fit.draws == 0) return std::nullopt;
  fit.pse_95 = percentiles95(pse);
  fit.jnd_95 = percentiles95(jnd);
  fit.deviance_p_value = static_cast<double>(worse) / fit.draws;
  return fit;
}

Interval wilson95(int hits, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  const double z = 1.959963984540054, n = trials, p = hits / n;
  const double centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace app
