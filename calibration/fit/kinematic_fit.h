// The most probable parameters of an arm under touches and priors, and how exactly its model can be true at all: what
// is left beyond the touches' own precision (frames bend, potentiometers wander) is estimated with the parameters, so
// that good data are believed closely and bad data are not. Frame W, mm, rad. Any thread but the servo's; 27 touches
// and 28 parameters about 0.5 ms. Not the finding of outliers (arm_fit), though one is robbed of its say. Sources:
// reference/calibration 3.1; MacKay, Neural Computation 4, 1992 (effective parameters).
#pragma once

#include <span>
#include <vector>

#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/touches.h"

namespace calibration {

/// What is expected of a touch against the arm beyond its precision, one sigma, an axis.
inline constexpr double kUsualMismatch_mm = 0.15;

struct KinematicFit {
  ArmParameters parameters{};
  ArmParameters sigma{};              ///< 1 sigma of those fitted, 0 of the others
  std::vector<std::size_t> fitted;    ///< of kArmParameters
  std::vector<double> covariance;     ///< of those fitted, row-major
  double mismatch_mm = 0.0;           ///< one sigma, an axis: of touches against the arm, beyond their precision
  double effective_parameters = 0.0;  ///< how many the touches, not the priors, decided
  int iterations = 0;
};

/// Touches at these indices. `near`: a fit of much the same touches: its parameters are the start, its mismatch is
/// kept.
KinematicFit kinematicFit(const ArmStart& start, const std::vector<Touch>& touches, std::span<const std::size_t> which,
                          const TouchPrecision& precision, std::vector<std::size_t> parameters,
                          const KinematicFit* near = nullptr);

/// One sigma of a touch against the arm, an axis of W.
glm::dvec3 touchSigma_mm(const TouchPrecision& precision, double mismatch_mm);

}  // namespace calibration
