// Maximum a posteriori fit of an arm's parameters, together with the mismatch: the error of the model (bending frames,
// drifting potentiometers) beyond the touches' precision, so that good touches get high and bad ones low weight. Frame
// W, mm, rad. Any thread but the servo's; 27 touches and 28 parameters about 0.5 ms. Outliers are down-weighted here
// and rejected in touch_agreement. Sources: reference/calibration 3.1; MacKay, Neural Computation 4, 1992 (effective
// parameters).
#pragma once

#include <span>
#include <vector>

#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/touches.h"

namespace calibration {

/// Usual model error of a touch beyond its precision, one sigma, an axis.
inline constexpr double kUsualMismatch_mm = 0.15;

struct KinematicFit {
  ArmParameters parameters{};
  ArmParameters sigma{};              ///< 1 sigma of the fitted ones, 0 of the others
  std::vector<std::size_t> fitted;    ///< indices in ArmParameters
  std::vector<double> covariance;     ///< of the fitted ones, row-major
  double mismatch_mm = 0.0;           ///< one sigma, an axis: model error beyond the touches' precision
  double effective_parameters = 0.0;  ///< determined by the touches rather than the priors
  int iterations = 0;
};

/// Touches at these indices. `near`: a fit of nearly the same touches; its parameters are the start, its mismatch is
/// kept.
KinematicFit kinematicFit(const ArmStart& start, const std::vector<Touch>& touches, std::span<const std::size_t> which,
                          const TouchPrecision& precision, std::vector<std::size_t> parameters,
                          const KinematicFit* near = nullptr);

/// One sigma of a touch against the arm, per axis of W.
glm::dvec3 touchSigma_mm(const TouchPrecision& precision, double mismatch_mm);

}  // namespace calibration
