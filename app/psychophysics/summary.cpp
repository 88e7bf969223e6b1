#include "app/psychophysics/summary.h"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/options/law_text.h"
#include "app/psychophysics/trial_table.h"
#include "app/text/version.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

using nlohmann::json;

constexpr int kDraws = 1000;

json jsonOf(const haptics::LawSettings& law) {
  haptics::LawSettings copy = law;
  json out{{"law", lawName(law.kind)}};
  for (const auto& [key, setting] : parametersOf(copy)) out[key] = *setting.value;
  return out;
}

json jsonOf(const Interval& interval) { return {interval.low, interval.high}; }

json jsonOf(const PsychometricFit& fit) {
  return {{"model", "lapse + (1 - 2 lapse) Phi((x - pse) / sigma)"},
          {"pse", fit.function.pse},
          {"pse_95", jsonOf(fit.pse_95)},
          {"jnd", fit.function.jnd()},
          {"jnd_95", jsonOf(fit.jnd_95)},
          {"sigma", fit.function.sigma},
          {"lapse", fit.function.lapse},
          {"log_likelihood", fit.log_likelihood},
          {"deviance", fit.deviance},
          {"deviance_share", fit.deviance_p_value},
          {"bootstrap_draws", fit.draws}};
}

/// Two-sided binomial test against chance (p = 1/2).
double coinChance(int hits, int trials) {
  double sum = 0.0;
  const int far = std::abs(2 * hits - trials);
  for (int k = 0; k <= trials; ++k)
    if (std::abs(2 * k - trials) >= far)
      sum += std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) -
                      trials * std::log(2.0));
  return std::min(1.0, sum);
}

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
json orNull(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

int countHarder(const Outcome& outcome) {
  return static_cast<int>(std::ranges::count_if(outcome.trials, &TrialRecord::comparison_harder));
}

}  // namespace

Outcome outcomeOf(const Protocol& protocol, const Experiment& experiment, std::vector<TrialRecord> trials,
                  bool complete, std::uint64_t seed) {
  Outcome outcome;
  std::map<double, LevelCount> counts;
  for (const TrialRecord& trial : trials) {
    const double level = trial.comparison.value_or(0.0);
    LevelCount& count = counts[level];
    count.level = level;
    ++count.trials;
    if (trial.comparison_harder) ++count.harder;
  }
  for (const auto& [level, count] : counts) outcome.counts.push_back(count);
  // Tracks have few trials where lapses would show, and a biased slope (Kaernbach 2001): no lapse is fitted.
  const std::optional<double> lapse = protocol.method == Method::staircase ? std::optional<double>(0.0) : std::nullopt;
  if (protocol.method != Method::pair) outcome.fit = fitWithIntervals(outcome.counts, kDraws, seed, lapse);
  outcome.tracks = experiment.tracks();
  double sum = 0.0;
  int known = 0;
  for (const Staircase& track : outcome.tracks)
    if (const double at = track.threshold(); std::isfinite(at)) sum += at, ++known;
  if (known > 0) outcome.threshold = sum / known;
  outcome.trials = std::move(trials);
  outcome.complete = complete;
  return outcome;
}

std::optional<double> trackJnd(const Protocol& protocol, const Outcome& outcome) {
  const std::optional<double> standard = protocol.standardValue();
  if (!outcome.threshold || !standard) return std::nullopt;
  const double z = normalQuantile(targetProbability(protocol.staircase));
  if (std::abs(z) < 0.1) return std::nullopt;
  return normalQuantile(0.75) * (*outcome.threshold - *standard) / z;
}

std::optional<double> weberFraction(const Protocol& protocol, const Outcome& outcome) {
  if (protocol.method == Method::staircase) {
    const std::optional<double> jnd = trackJnd(protocol, outcome), standard = protocol.standardValue();
    return jnd && *standard > 0.0 ? std::optional<double>(*jnd / *standard) : std::nullopt;
  }
  if (!outcome.fit) return std::nullopt;
  const double reference = protocol.standardValue().value_or(outcome.fit->function.pse);
  if (!(reference > 0.0)) return std::nullopt;
  return outcome.fit->function.jnd() / reference;
}

std::string summaryJson(const Protocol& protocol, const Outcome& outcome, std::uint64_t seed,
                        const std::string& observer) {
  json out{{"title", protocol.title},
           {"participant", protocol.participant},
           {"method", methodName(protocol.method)},
           {"observer", observer},
           {"seed", seed},
           {"program", programVersion()},
           {"complete", outcome.complete},
           {"trials", outcome.trials.size()},
           {"standard", jsonOf(protocol.standard)},
           {"comparison", jsonOf(protocol.comparison)}};
  int correct = 0, judged = 0, comparison_first = 0;
  for (const TrialRecord& t : outcome.trials) {
    if (t.correct) ++judged, correct += *t.correct ? 1 : 0;
    comparison_first += t.comparison_first ? 1 : 0;
  }
  out["comparison_first"] = comparison_first;
  if (judged > 0) out["share_correct"] = static_cast<double>(correct) / judged;
  if (!protocol.parameter.empty()) {
    out["parameter"] = protocol.parameter;
    out["unit"] = protocol.unit;
    out["comparison"].erase(protocol.parameter);
    json levels = json::array();
    for (const LevelCount& c : outcome.counts)
      levels.push_back({{"level", c.level},
                        {"trials", c.trials},
                        {"harder", c.harder},
                        {"share_95", jsonOf(wilson95(c.harder, c.trials))}});
    out["levels"] = levels;
    out["fit"] = outcome.fit ? jsonOf(*outcome.fit) : json(nullptr);
    out["weber_fraction"] = orNull(weberFraction(protocol, outcome));
  }
  if (protocol.method == Method::staircase) {
    json tracks = json::array();
    for (std::size_t i = 0; i < outcome.tracks.size(); ++i)
      tracks.push_back({{"start", protocol.levels[i]},
                        {"reversals", outcome.tracks[i].reversals()},
                        {"threshold", finite(outcome.tracks[i].threshold())},
                        {"standard_error", finite(outcome.tracks[i].standardError())}});
    out["staircase"] = {{"target_probability", targetProbability(protocol.staircase)},
                        {"threshold", orNull(outcome.threshold)},
                        {"jnd", orNull(trackJnd(protocol, outcome))},
                        {"tracks", tracks}};
  }
  if (protocol.method == Method::pair && !outcome.trials.empty()) {
    const int n = static_cast<int>(outcome.trials.size()), harder = countHarder(outcome);
    out["harder"] = {{"count", harder},
                     {"share", static_cast<double>(harder) / n},
                     {"share_95", jsonOf(wilson95(harder, n))},
                     {"chance_of_coin", coinChance(harder, n)}};
  }
  return out.dump(2) + "\n";
}

std::string outcomeText(const Protocol& protocol, const Outcome& outcome) {
  const auto number = [](double v) { return fmt::format("{:.4g}", v); };
  const std::string unit = protocol.unit.empty() ? "" : " " + protocol.unit;
  std::string text = "Psychophysics, participant " + protocol.participant + "\n  trials           " +
                     std::to_string(outcome.trials.size()) + (outcome.complete ? "" : ", ended early") + "\n";
  if (outcome.trials.empty())
    return text + "  nothing was answered, so nothing is estimated: feel with 1 and 2, then answer with A or B\n";
  if (outcome.fit && protocol.method == Method::constant) {
    const PsychometricFit& f = *outcome.fit;
    text += "  PSE              " + number(f.function.pse) + unit + "  (95 %: " + number(f.pse_95.low) + " to " +
            number(f.pse_95.high) + ")\n";
    text += "  JND (75 %)       " + number(f.function.jnd()) + unit + "  (95 %: " + number(f.jnd_95.low) + " to " +
            number(f.jnd_95.high) + ")\n";
    if (const auto weber = weberFraction(protocol, outcome)) text += "  Weber fraction   " + number(*weber) + "\n";
    if (f.deviance_p_value < 0.05)
      text += "  the curve fits the answers badly: look at the picture before believing it\n";
  } else if (protocol.method == Method::constant) {
    text += "  no psychometric function: the answers do not rise with " + protocol.parameter + "\n";
  }
  if (outcome.threshold)
    text += "  threshold        " + number(*outcome.threshold) + unit + "  where " +
            number(100.0 * targetProbability(protocol.staircase)) + " % feel the comparison harder\n";
  if (const auto jnd = trackJnd(protocol, outcome); jnd && protocol.method == Method::staircase)
    text += "  JND (75 %)       " + number(*jnd) + unit + "  from threshold and standard, Weber fraction " +
            number(*weberFraction(protocol, outcome)) + "\n";
  if (protocol.method == Method::pair) {
    const int n = static_cast<int>(outcome.trials.size()), harder = countHarder(outcome);
    const Interval share = wilson95(harder, n);
    text += "  comparison harder in " + std::to_string(harder) + " of " + std::to_string(n) +
            "  (95 %: " + number(share.low) + " to " + number(share.high) + ")\n";
  }
  return text;
}

}  // namespace app
