// An experiment trial by trial: the order gives the next trial, a participant feels both intervals and answers, the
// order adapts, and each answered trial is one record. The same for simulated and real participants. One thread.
#pragma once

#include <functional>
#include <optional>

#include "app/psychophysics/trial_order.h"
#include "haptics/servo/command.h"

namespace app {

struct TrialRecord {
  int trial = 0;  ///< from 1
  std::size_t track = 0;
  bool comparison_first = false;
  std::optional<double> standard, comparison;  ///< values of the varied parameter
  bool comparison_harder = false;
  std::optional<bool> correct;  ///< none if undefined: equal stimuli, or different laws
  bool reversal = false;
  int reversals = 0;  ///< of this track so far
  ProbeMeasures standard_measures, comparison_measures;
  std::optional<double> response_s;  ///< a person's time to the answer
};

class Experiment {
 public:
  Experiment(const Protocol& protocol, std::uint64_t seed) : protocol_(protocol), order_(protocol, seed) {}

  /// Goes to the next trial; false at the end.
  bool next();
  /// Stimulus of the first (0) or second (1) interval of this trial.
  haptics::Command commandOf(int interval) const;
  /// The answer to this trial.
  TrialRecord answer(bool second_harder, const ProbeMeasures& first, const ProbeMeasures& second,
                     std::optional<double> response_s = {});

  int trial() const { return trial_; }
  int most() const { return order_.most(); }
  const std::vector<Staircase>& tracks() const { return order_.tracks(); }

 private:
  Protocol protocol_;
  TrialOrder order_;
  PlannedTrial planned_;
  int trial_ = 0;
};

/// Runs every trial with the protocol's simulated hand and observer; `on_trial` is called after each.
Experiment runSimulated(const Protocol& protocol, haptics::Bodies& bodies, const ProbeSite& site, std::uint64_t seed,
                        const std::function<void(const TrialRecord&, const Experiment&)>& on_trial);

}  // namespace app
