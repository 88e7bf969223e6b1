// The order of trials: level of the comparison, and which stimulus comes first. Blind and balanced, from one seed:
// constant stimuli in shuffled blocks with every level in both orders once; staircase tracks mixed at random, the two
// orders in shuffled blocks of eight. Answers adapt the tracks. Pure state; any one thread.
#pragma once

#include <optional>
#include <vector>

#include "app/psychophysics/protocol.h"
#include "calibration/random.h"

namespace app {

struct PlannedTrial {
  double level = 0.0;  ///< of the comparison; 0 if nothing varies
  std::size_t track = 0;
  bool comparison_first = false;
};

class TrialOrder {
 public:
  TrialOrder(const Protocol& protocol, std::uint64_t seed);

  /// None at the end.
  std::optional<PlannedTrial> next();
  /// The answer to the last trial of next(). True if its track reversed.
  bool answer(bool comparison_harder);

  /// Upper limit of the number of trials.
  int most() const { return most_; }
  const std::vector<Staircase>& tracks() const { return tracks_; }

 private:
  bool nextOrder();

  calibration::RandomGenerator rng_;
  std::vector<PlannedTrial> planned_;  ///< constant and pair, all of them
  std::vector<Staircase> tracks_;
  std::vector<bool> orders_;
  std::size_t given_ = 0, track_ = 0;
  int most_ = 0;
};

}  // namespace app
