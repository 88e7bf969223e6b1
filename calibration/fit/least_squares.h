// Levenberg-Marquardt least squares with Gaussian priors on the parameters and Cauchy's kernel on groups of residuals
// (x, y, z of a touch; u, v of an image point). Residuals are in sigmas. Dense, for 3 to 100 parameters and up to a few
// thousand residuals: a step of 46 parameters and 800 residuals takes about 1 ms and one Jacobian. Any thread but the
// servo's; allocates. No bounds. Sources: Marquardt 1963; damping after Madsen, Nielsen, Tingleff, IMM 2004.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace calibration {

struct LeastSquares {
  /// Sigma 0: no prior.
  struct Prior {
    double middle = 0.0, sigma = 0.0;
  };
  /// The next `residuals` residuals share one weight 1 / (1 + s / cauchy^2), s their sum of squares. Cauchy 0: weight
  /// 1.
  struct Group {
    std::size_t residuals = 1;
    double cauchy = 0.0;
  };

  std::vector<double> start;
  std::size_t residuals = 0;
  /// r(x) in sigmas; NaN where undefined: the step is shortened.
  std::function<void(std::span<const double> x, std::span<double> r)> residuals_at;
  /// dr/dx, row-major, one row per residual; zeroed before the call.
  std::function<void(std::span<const double> x, std::span<double> J)> jacobian_at;
  std::vector<Prior> priors;          ///< one per parameter; empty: none
  std::vector<Group> groups;          ///< in order, together all residuals; empty: each alone, weight 1
  int max_iterations = 60;            ///< evaluations of the Jacobian
  double relative_tolerance = 1e-10;  ///< stop when a step lowers the cost by a smaller fraction
};

struct LeastSquaresResult {
  std::vector<double> parameters;
  double cost = 0.0;  ///< half the sum of kernels and prior terms
  int iterations = 0;
  bool converged = false;          ///< false: max_iterations, or undefined at the start
  std::vector<double> weights;     ///< one per group, at the end; empty without groups
  std::vector<double> covariance;  ///< (J^T W J + priors)^-1, row-major; empty: parameters not determined
  double effective_parameters =
      0.0;  ///< trace of covariance times J^T W J: parameters determined by measurements rather than priors
};

/// Deterministic on one machine.
LeastSquaresResult solved(const LeastSquares& problem);

}  // namespace calibration
