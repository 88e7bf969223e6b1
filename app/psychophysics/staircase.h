// An adaptive track: after `down` answers "comparison harder" in a row the level falls a step, after `up` answers
// "standard harder" in a row it rises one (transformed up-down, Levitt, JASA 49:467, 1971). Steps are added or
// multiplied, get smaller with the reversals, and may be longer upwards than downwards (weighted, Kaernbach 1991).
// With p the chance of "comparison harder" the track settles where the chance that a run ends downwards,
//   p^(d-1) (1 - q^u) / (p^(d-1) + q^(u-1) - p^(d-1) q^(u-1)),  q = 1 - p,
// is w / (1 + w), w = up step : down step. 1 up, 2 down: p = sqrt(1/2) = 70.7 %. Pure state; any one thread.
#pragma once

#include <cstdint>
#include <vector>

namespace app {

enum class StepKind : std::uint8_t { added, ratio };

struct StaircaseRule {
  int up = 1, down = 2;
  StepKind kind = StepKind::added;
  std::vector<double> steps{0.1};  ///< in the parameter's unit, or as a ratio above 1; one for every stage
  int reversals_per_step = 2;      ///< then the next step, until the last
  double up_to_down = 1.0;         ///< size of an upward step over a downward step (of the logarithms, for ratios)
  int reversals = 12;              ///< the track ends with this many
  int discarded = 4;               ///< first reversals that the threshold leaves out
  int max_trials = 200;
  double low = 0.0, high = 0.0;  ///< the level stays within
};

/// The chance of "comparison harder" at which a track settles.
double targetProbability(const StaircaseRule& rule);

class Staircase {
 public:
  Staircase(const StaircaseRule& rule, double start) : rule_(rule), level_(start) {}

  double level() const { return level_; }
  bool over() const;
  int reversals() const { return static_cast<int>(reversal_levels_.size()); }

  /// True if this answer reversed the track.
  bool answer(bool comparison_harder);

  /// Mean (of the logarithms, for ratios) of an even number of last reversals after the discarded ones; NaN while there
  /// are fewer than two.
  double threshold() const;
  /// Its standard error from the pairs of reversals; NaN while there are fewer than two pairs.
  double standardError() const;

 private:
  std::vector<double> pairMeans() const;

  StaircaseRule rule_;
  double level_;
  int trials_ = 0, run_ = 0, direction_ = 0;
  bool run_is_harder_ = false;
  std::vector<double> reversal_levels_;
};

}  // namespace app
