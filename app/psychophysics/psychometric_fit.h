// The psychometric function of a forced choice between standard and comparison: the chance of "comparison harder",
//   psi(x) = lapse + (1 - 2 lapse) Phi((x - PSE) / sigma),
// fitted by maximum likelihood, lapse within 0..0.06 and the same at both ends (Wichmann and Hill, Perception &
// Psychophysics 63:1293 and 1314, 2001). JND = Phi^-1(3/4) sigma = 0.6745 sigma, from 50 % to 75 % of answers without
// lapse. Intervals: parametric bootstrap, percentiles; the same draws test the goodness of fit by the deviance.
// Unit: that of the parameter. Pure; any thread; milliseconds a fit, a second for 1,000 draws.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace app {

/// The answers at one level.
struct LevelCount {
  double level = 0.0;
  int trials = 0;
  int harder = 0;  ///< answers "comparison harder"
};

struct Psychometric {
  double pse = 0.0, sigma = 1.0, lapse = 0.0;

  double probability(double level) const;
  double jnd() const;
};

struct Interval {
  double low = 0.0, high = 0.0;
};

struct PsychometricFit {
  Psychometric function;
  double log_likelihood = 0.0;
  double deviance = 0.0;
  Interval pse_95, jnd_95;        ///< of the bootstrap
  double deviance_p_value = 1.0;  ///< share of draws that fit worse than the answers; below 0.05 the model is doubtful
  int draws = 0;
};

double normalCdf(double z);       ///< Phi
double normalQuantile(double p);  ///< Phi^-1, 0 < p < 1

/// None if there is no slope: fewer than two levels, all answers equal, or not rising with the level.
/// `fixed_lapse`: given instead of fitted.
std::optional<Psychometric> fitPsychometric(const std::vector<LevelCount>& counts,
                                            std::optional<double> fixed_lapse = {});

/// The fit with its intervals from `draws` repetitions of the experiment by the fitted observer.
std::optional<PsychometricFit> fitWithIntervals(const std::vector<LevelCount>& counts, int draws, std::uint64_t seed,
                                                std::optional<double> fixed_lapse = {});

/// Wilson's 95 % interval of a share (JASA 22:209, 1927).
Interval wilson95(int hits, int trials);

}  // namespace app
