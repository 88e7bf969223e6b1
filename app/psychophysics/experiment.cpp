#include "app/psychophysics/experiment.h"

namespace app {

bool Experiment::next() {
  const std::optional<PlannedTrial> planned = order_.next();
  if (!planned) return false;
  planned_ = *planned;
  ++trial_;
  return true;
}

haptics::Command Experiment::commandOf(int interval) const {
  haptics::Command command;
  command.tool = protocol_.tool;
  command.drill_enabled = false;
  command.safety.peak_force_N = protocol_.peak_force_N;
  const bool is_comparison = (interval == 0) == planned_.comparison_first;
  command.law = is_comparison ? protocol_.comparisonAt(planned_.level) : protocol_.standard;
  return command;
}

TrialRecord Experiment::answer(bool second_harder, const ProbeMeasures& first, const ProbeMeasures& second,
                               std::optional<double> response_s) {
  TrialRecord record;
  record.trial = trial_;
  record.track = planned_.track;
  record.comparison_first = planned_.comparison_first;
  record.standard = protocol_.standardValue();
  if (!protocol_.parameter.empty()) record.comparison = planned_.level;
  record.comparison_harder = second_harder != planned_.comparison_first;
  if (record.standard && record.comparison && *record.standard != *record.comparison)
    record.correct = record.comparison_harder == (*record.comparison > *record.standard);
  record.standard_measures = planned_.comparison_first ? second : first;
  record.comparison_measures = planned_.comparison_first ? first : second;
  record.response_s = response_s;
  record.reversal = order_.answer(record.comparison_harder);
  if (!order_.tracks().empty()) record.reversals = order_.tracks()[planned_.track].reversals();
  return record;
}

Experiment runSimulated(const Protocol& protocol, haptics::Bodies& bodies, const ProbeSite& site, std::uint64_t seed,
                        const std::function<void(const TrialRecord&, const Experiment&)>& on_trial) {
  Experiment experiment(protocol, seed);
  SimulatedObserver observer(protocol.observer, seed);
  calibration::RandomGenerator hand(seed, 2);
  while (experiment.next()) {
    const ProbeMeasures first = measuresOf(probe(bodies, site, experiment.commandOf(0), protocol.probe, hand));
    const ProbeMeasures second = measuresOf(probe(bodies, site, experiment.commandOf(1), protocol.probe, hand));
    on_trial(experiment.answer(observer.secondHarder(first, second), first, second), experiment);
  }
  return experiment;
}

}  // namespace app
