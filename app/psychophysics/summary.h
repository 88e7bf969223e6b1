// The results of an experiment: answers by level, psychometric function with intervals, thresholds of the tracks; as
// JSON and as text. Weber fraction: JND over the standard's value of the parameter, or over the PSE where the standard
// is another law. Pure; the bootstrap takes about a second. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/psychophysics/experiment.h"
#include "app/psychophysics/psychometric_fit.h"

namespace app {

struct Outcome {
  std::vector<TrialRecord> trials;
  std::vector<LevelCount> counts;      ///< by rising level; a single level 0 if nothing varies
  std::optional<PsychometricFit> fit;  ///< none if there is no slope
  std::vector<Staircase> tracks;
  std::optional<double> threshold;  ///< mean over the tracks, at the staircase's target
  bool complete = false;            ///< every planned trial was answered
};

Outcome outcomeOf(const Protocol& protocol, const Experiment& experiment, std::vector<TrialRecord> trials,
                  bool complete, std::uint64_t seed);

/// From the threshold of the tracks, with the standard as PSE: 0.6745 (threshold - standard) / Phi^-1(p).
std::optional<double> trackJnd(const Protocol& protocol, const Outcome& outcome);

/// From the tracks of a staircase, else from the fit.
std::optional<double> weberFraction(const Protocol& protocol, const Outcome& outcome);

std::string summaryJson(const Protocol& protocol, const Outcome& outcome, std::uint64_t seed,
                        const std::string& observer);
std::string outcomeText(const Protocol& protocol, const Outcome& outcome);

}  // namespace app
