// The most probable parameters under measurements and priors: Levenberg and Marquardt's least squares with priors on
// the parameters and Cauchy's kernel on groups of residuals that belong together (x, y, z of a touch; u, v of a image
// point), so that a wild one loses its say. Residuals come divided by their sigma. Dense; for 3 to 100 parameters and
// up to a few thousand residuals: a step of 46 parameters and 800 residuals is about 1 ms and one Jacobian. Any thread
// but the servo's; allocates. Not for bounds. Sources: Marquardt 1963; damping after Madsen, Nielsen, Tingleff, IMM
// 2004.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace calibration {

struct LeastSquares {
  /// What is believed of a number before measuring. Sigma 0: nothing.
  struct Prior {
    double middle = 0.0, sigma = 0.0;
  };
  /// The next `residuals` of them share one weight 1 / (1 + s / cauchy^2), s their sum of squares. Cauchy 0: weight 1.
  struct Group {
    std::size_t residuals = 1;
    double cauchy = 0.0;
  };

  std::vector<double> start;
  std::size_t residuals = 0;
  /// r(x), each over its sigma. A place that can not be evaluated: leave NaN, the step is shortened.
  std::function<void(std::span<const double> x, std::span<double> r)> residuals_at;
  /// dr/dx, row-major, a row a residual; comes zeroed. Empty: central differences by 1e-6 of each prior's sigma, or by
  /// 1e-6.
  std::function<void(std::span<const double> x, std::span<double> J)> jacobian_at;
  std::vector<Prior> priors;          ///< one a number; empty: none
  std::vector<Group> groups;          ///< in order, together all residuals; empty: each alone, weight 1
  int max_iterations = 60;            ///< evaluations of the Jacobian
  double relative_tolerance = 1e-10;  ///< a step that lowers the cost by a smaller share is the last
};

struct LeastSquaresResult {
  std::vector<double> parameters;
  double cost = 0.0;  ///< half of sum of the kernels of r^2, and of the priors
  int iterations = 0;
  bool converged = false;          ///< false: max_iterations, or the start can not be evaluated
  std::vector<double> weights;     ///< one a group, at the end; empty without groups
  std::vector<double> covariance;  ///< (J^T W J + priors)^-1, row-major; empty: the parameters are not determined
  double effective_parameters =
      0.0;  ///< trace of covariance times J^T W J: what the measurements, not the priors, said
};

/// Deterministic: the same parameters for the same input on one machine.
LeastSquaresResult solved(const LeastSquares& problem);

}  // namespace calibration
