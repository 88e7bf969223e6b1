// Least squares of touches over some of an arm's parameters: tip by the arm minus target. Frame W, mm, rad. Any thread
// but the servo's. Touches, start and parameters are borrowed.
#pragma once

#include <span>
#include <vector>

#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/least_squares.h"
#include "calibration/fit/touches.h"

namespace calibration {

class ArmProblem {
 public:
  /// Touches and parameters by index, the parameters under their priors. `cauchy`: of a touch, in sigmas.
  ArmProblem(const ArmStart& start, const std::vector<Touch>& touches, std::span<const std::size_t> which,
             std::span<const std::size_t> parameters, double cauchy);
  ArmProblem(const ArmProblem&) = delete;
  ArmProblem& operator=(const ArmProblem&) = delete;

  /// `sigma_mm`: of a touch, an axis of W.
  LeastSquaresResult solvedFrom(const ArmParameters& parameters, const glm::dvec3& sigma_mm);
  /// All parameters from those fitted, 0 for the others.
  ArmParameters all(std::span<const double> x) const;

  LeastSquares min_squares;  ///< priors and limits may be changed before solving

 private:
  void residuals(std::span<const double> x, std::span<double> r) const;
  void jacobian(std::span<const double> x, std::span<double> J) const;

  const ArmStart& start_;
  const std::vector<Touch>& touches_;
  std::span<const std::size_t> which_, parameters_;
  glm::dvec3 sigma_mm_{1.0};
};

/// Root mean square tip error over the touches at these indices.
double rms_mm(const MeasuredArm& arm, const std::vector<Touch>& touches, std::span<const std::size_t> which);

}  // namespace calibration
