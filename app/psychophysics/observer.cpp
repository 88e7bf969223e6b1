#include "app/psychophysics/observer.h"

#include <numbers>

namespace app {

double noiseShare(const ObserverSettings& settings) {
  return settings.weber_fraction / (0.6744897501960817 * std::numbers::sqrt2);
}

double SimulatedObserver::perceived(const ProbeMeasures& felt) {
  const double cue = settings_.cue == Cue::stiffness ? felt.stiffness_N_per_mm : felt.peak_force_N;
  return cue * (1.0 + noiseShare(settings_) * rng_.normal());
}

bool SimulatedObserver::secondHarder(const ProbeMeasures& first, const ProbeMeasures& second) {
  // Drawn in every trial, so that a lapse does not shift the noise of the trials after it.
  const double a = perceived(first), b = perceived(second);
  const bool lapses = rng_.coin(settings_.lapse_rate), guess = rng_.coin(0.5);
  return lapses ? guess : b > a;
}

}  // namespace app
