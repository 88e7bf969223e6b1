// A simulated participant: chooses the harder of two intervals from their measures, with Weber's law as noise and
// occasional lapses. The noise of one interval is a fraction nu of the measure; two intervals are compared, so nu = w /
// (0.6745 sqrt 2) gives a just noticeable difference (75 %) of w times the standard. For tests and planning; no bias,
// memory or learning. One thread.
#pragma once

#include <cstdint>

#include "app/psychophysics/probe_measures.h"
#include "calibration/random.h"

namespace app {

/// The measure by which hardness is compared.
enum class Cue : std::uint8_t { stiffness, peak_force };

struct ObserverSettings {
  Cue cue = Cue::stiffness;
  double weber_fraction = 0.15;  ///< JND over standard; stiffness of people: 0.08..0.22 (reference/physics 4)
  double lapse_rate = 0.02;      ///< share of trials answered at random
};

double noiseShare(const ObserverSettings& settings);

class SimulatedObserver {
 public:
  SimulatedObserver(const ObserverSettings& settings, std::uint64_t seed) : settings_(settings), rng_(seed, 3) {}

  /// True if the second interval felt harder than the first.
  bool secondHarder(const ProbeMeasures& first, const ProbeMeasures& second);

 private:
  double perceived(const ProbeMeasures& felt);

  ObserverSettings settings_;
  calibration::RandomGenerator rng_;
};

}  // namespace app
