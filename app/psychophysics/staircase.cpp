#include "app/psychophysics/staircase.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace app {
namespace {

double chanceOfDown(double p, int up, int down) {
  const double p_run = std::pow(p, down - 1), q_run = std::pow(1.0 - p, up - 1);
  return p_run * (1.0 - q_run * (1.0 - p)) / (p_run + q_run - p_run * q_run);
}

double scaled(const StaircaseRule& rule, double level) {
  return rule.kind == StepKind::ratio ? std::log(level) : level;
}
double unscaled(const StaircaseRule& rule, double value) {
  return rule.kind == StepKind::ratio ? std::exp(value) : value;
}

}  // namespace

double targetProbability(const StaircaseRule& rule) {
  const double wanted = rule.up_to_down / (1.0 + rule.up_to_down);
  double low = 1e-12, high = 1.0 - 1e-12;
  while (high - low > 1e-13) {
    const double middle = 0.5 * (low + high);
    (chanceOfDown(middle, rule.up, rule.down) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool Staircase::over() const { return reversals() >= rule_.reversals || trials_ >= rule_.max_trials; }

bool Staircase::answer(bool comparison_harder) {
  ++trials_;
  run_ = comparison_harder == run_is_harder_ ? run_ + 1 : 1;
  run_is_harder_ = comparison_harder;
  if (run_ < (comparison_harder ? rule_.down : rule_.up)) return false;
  run_ = 0;

  // A reversal is recorded at the level before the step.
  const int direction = comparison_harder ? -1 : 1;
  const bool turned = direction_ != 0 && direction != direction_;
  direction_ = direction;
  if (turned) reversal_levels_.push_back(level_);
  const auto stage =
      std::min(rule_.steps.size() - 1,
               reversal_levels_.size() / static_cast<std::size_t>(std::max(1, rule_.reversals_per_step)));
  const double size = rule_.kind == StepKind::ratio ? std::log(rule_.steps[stage]) : rule_.steps[stage];
  const double step = size * (direction > 0 ? rule_.up_to_down : -1.0);
  level_ = std::clamp(unscaled(rule_, scaled(rule_, level_) + step), rule_.low, rule_.high);
  return turned;
}

std::vector<double> Staircase::pairMeans() const {
  std::vector<double> means;
  const std::size_t first = static_cast<std::size_t>(rule_.discarded);
  // From the end, so an unpaired reversal is the oldest.
  for (std::size_t i = reversal_levels_.size(); i >= first + 2; i -= 2)
    means.push_back(0.5 * (scaled(rule_, reversal_levels_[i - 1]) + scaled(rule_, reversal_levels_[i - 2])));
  return means;
}

double Staircase::threshold() const {
  const std::vector<double> means = pairMeans();
  if (means.empty()) return std::numeric_limits<double>::quiet_NaN();
  return unscaled(rule_, std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(means.size()));
}

double Staircase::standardError() const {
  const std::vector<double> means = pairMeans();
  if (means.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double n = static_cast<double>(means.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / n;
  double squares = 0.0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  const double error = std::sqrt(squares / (n - 1.0) / n);
  return rule_.kind == StepKind::ratio ? error * std::exp(mean) : error;
}

}  // namespace app
