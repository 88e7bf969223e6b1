#include "app/psychophysics/result_chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/options/law_text.h"
#include "app/psychophysics/trial_table.h"

namespace app {
namespace {

constexpr int kAnswers = 0, kFit = 1;
constexpr int kCurveSteps = 200, kFewest = 3;

std::string shortNumber(double value) { return fmt::format("{:.3g}", value); }

std::string valueLabel(const Protocol& protocol) {
  return "comparison " + protocol.parameter.substr(0, protocol.parameter.find('_')) +
         (protocol.unit.empty() ? "" : " / (" + protocol.unit + ")");
}

/// Answers as dots, larger for more trials, with Wilson's bars; the fitted curve; vertical lines at standard and PSE.
Panel psychometricPanel(const Protocol& protocol, const Outcome& outcome) {
  Panel panel;
  panel.title = "Psychometric function";
  panel.x_label = valueLabel(protocol);
  panel.y_label = "share \u201ccomparison harder\u201d";
  Curve answers{"answers, 95 %", kAnswers, {}, false, true, false, {}, {}};
  int most = 1;
  for (const LevelCount& c : outcome.counts) most = std::max(most, c.trials);
  for (const LevelCount& c : outcome.counts) {
    answers.points.emplace_back(c.level, static_cast<double>(c.harder) / c.trials);
    // No interval for one or two answers.
    const double hit = answers.points.back().y;
    const Interval share = c.trials < kFewest ? Interval{hit, hit} : wilson95(c.harder, c.trials);
    answers.bars.emplace_back(share.low, share.high);
    answers.sizes.push_back(0.6 + 0.8 * std::sqrt(static_cast<double>(c.trials) / most));
  }
  if (answers.points.empty()) return panel;
  double low = outcome.counts.front().level, high = outcome.counts.back().level;
  const double margin = std::max(0.05 * (high - low), 1e-6);
  low -= margin, high += margin;
  if (outcome.fit) {
    Curve curve{"cumulative Gaussian", kFit, {}, true, false, false, {}, {}};
    for (int n = 0; n <= kCurveSteps; ++n) {
      const double x = std::lerp(low, high, static_cast<double>(n) / kCurveSteps);
      curve.points.emplace_back(x, outcome.fit->function.probability(x));
    }
    panel.curves.push_back(curve);
    const double pse = outcome.fit->function.pse;
    if (pse > low && pse < high) panel.lines.push_back({"PSE " + shortNumber(pse), pse, false});
  }
  panel.lines.push_back({"", 0.5, true});
  panel.lines.push_back({"75 %", 0.75, true});
  panel.curves.push_back(answers);
  panel.x_range = glm::dvec2(low, high);
  panel.y_range = glm::dvec2(0.0, 1.0);
  return panel;
}

Panel trackPanel(const Protocol& protocol, const Outcome& outcome) {
  Panel panel;
  panel.title = "Staircase";
  panel.x_label = "trial";
  panel.y_label = valueLabel(protocol);
  for (std::size_t t = 0; t < outcome.tracks.size(); ++t) {
    const int colour = static_cast<int>(t) + 2;
    Curve way{"track " + std::to_string(t + 1), colour, {}, true, false, false, {}, {}};
    Curve turns{"", colour, {}, false, true, false, {}, {}};
    for (const TrialRecord& trial : outcome.trials) {
      if (trial.track != t || !trial.comparison) continue;
      way.points.emplace_back(trial.trial, *trial.comparison);
      if (trial.reversal) turns.points.emplace_back(trial.trial, *trial.comparison);
    }
    panel.curves.push_back(way);
    panel.curves.push_back(turns);
  }
  if (outcome.threshold)
    panel.lines.push_back({"threshold " + shortNumber(*outcome.threshold), *outcome.threshold, true});
  if (const auto standard = protocol.standardValue())
    panel.lines.push_back({"standard " + shortNumber(*standard), *standard, true});
  panel.x_range = glm::dvec2(0.0, static_cast<double>(outcome.trials.size()) + 1.0);
  return panel;
}

Panel sharePanel(const Outcome& outcome) {
  Panel panel;
  panel.title = "Comparison harder, so far";
  panel.x_label = "trial";
  panel.y_label = "share";
  Curve share{"share of answers", kAnswers, {}, true, false, false, {}, {}};
  int harder = 0;
  for (const TrialRecord& trial : outcome.trials) {
    harder += trial.comparison_harder ? 1 : 0;
    share.points.emplace_back(trial.trial, static_cast<double>(harder) / trial.trial);
  }
  panel.curves = {share};
  panel.lines = {{"coin", 0.5, true}};
  panel.x_range = glm::dvec2(0.0, static_cast<double>(outcome.trials.size()) + 1.0);
  panel.y_range = glm::dvec2(0.0, 1.0);
  return panel;
}

}  // namespace

Chart chartOf(const Protocol& protocol, const Outcome& outcome) {
  Chart chart;
  chart.title = protocol.title.empty() ? "Which felt harder?" : protocol.title;
  chart.caption = "Participant " + protocol.participant + ", " + std::to_string(outcome.trials.size()) +
                  " trials, standard: " + lawName(protocol.standard.kind) +
                  ", comparison: " + lawName(protocol.comparison.kind) + ".";
  if (outcome.fit && protocol.method == Method::constant)
    chart.caption += " JND (75 %) " + shortNumber(outcome.fit->function.jnd()) + " " + protocol.unit + " [" +
                     shortNumber(outcome.fit->jnd_95.low) + ", " + shortNumber(outcome.fit->jnd_95.high) + "].";
  if (const auto jnd = trackJnd(protocol, outcome); jnd && protocol.method == Method::staircase)
    chart.caption += " JND (75 %) " + shortNumber(*jnd) + " " + protocol.unit + ", from threshold and standard.";
  if (const auto weber = weberFraction(protocol, outcome))
    chart.caption += " Weber fraction " + shortNumber(*weber) + ".";
  if (protocol.method == Method::staircase) chart.panels.push_back(trackPanel(protocol, outcome));
  if (protocol.method == Method::pair)
    chart.panels.push_back(sharePanel(outcome));
  else
    chart.panels.push_back(psychometricPanel(protocol, outcome));
  if (chart.panels.size() == 1) chart.size.x = 544.0;
  return chart;
}

}  // namespace app
