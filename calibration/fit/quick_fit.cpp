#include "calibration/fit/quick_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calibration/fit/arm_problem.h"
#include "calibration/fit/kinematic_fit.h"
#include "calibration/median.h"

namespace calibration {
namespace {

// Rotation and translation of the base, the tip, offsets of six joints.
constexpr std::array<std::size_t, 15> kQuickNumbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 20, 21, 22};
constexpr std::array<double, 15> kSigma = {0.1, 0.1,   0.1,   30.0,  30.0, 30.0, 1.0, 1.0,
                                           1.0, 0.015, 0.015, 0.015, 0.02, 0.02, 0.02};
constexpr double kMismatch_mm = 0.3;  ///< model error of so few parameters, an axis
constexpr double kCauchy = 3.0;
constexpr std::size_t kMinTouches = 4;
constexpr double kDoubt = 3.0, kMinDoubt = 4.5;  ///< robust sigmas; lower limit in sigmas of a touch

/// Leave-one-out residual of a touch: (I - w J C J^T)^-1 r; each axis in sigmas.
glm::dvec3 leftOut(const TipJacobian& tip, const std::vector<double>& covariance, const Touch& touch, double weight,
                   const glm::dvec3& sigma_mm) {
  const glm::dvec3 left = (tip.tip_W_mm - touch.target_W.mm) / sigma_mm;
  if (covariance.empty()) return left;
  glm::dmat3 remains(1.0);
  for (std::size_t a = 0; a < kQuickNumbers.size(); ++a)
    for (std::size_t b = 0; b < kQuickNumbers.size(); ++b)
      remains -= weight * covariance[a * kQuickNumbers.size() + b] *
                 glm::outerProduct(tip.by_parameter[kQuickNumbers[a]] / sigma_mm,
                                   tip.by_parameter[kQuickNumbers[b]] / sigma_mm);
  return glm::determinant(remains) > 1e-9 ? glm::inverse(remains) * left : left;
}

}  // namespace

QuickFit quickFit(const MeasuredArm& start, const TouchSet& set) {
  QuickFit quick{start, {}, std::vector<bool>(set.touches.size(), false), 0.0};
  const std::vector<Touch>& touches = set.touches;
  const glm::dvec3 sigma_mm = touchSigma_mm(set.precision, kMismatch_mm);
  quick.left_out_mm.assign(touches.size(), {});
  if (touches.size() < kMinTouches) return quick;

  // Rotate the base about its own origin.
  const ArmStart from{start.geometry, start.X_WD, {start.X_WD.translation_mm}, start.correction};
  std::vector<std::size_t> all(touches.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  ArmProblem problem(from, touches, all, kQuickNumbers, kCauchy);
  problem.min_squares.priors.clear();
  for (const double sigma : kSigma) problem.min_squares.priors.push_back({0.0, sigma});
  problem.min_squares.max_iterations = 20;
  const LeastSquaresResult fit = problem.solvedFrom({}, sigma_mm);
  const ArmParameters parameters = problem.all(fit.parameters);
  quick.arm = armOf(from, parameters);

  // Leave-one-out errors.
  std::vector<double> errors;
  std::vector<double> left_mm;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const TipJacobian tip = tipJacobian(from, parameters, touches[i].joints_rad);
    const glm::dvec3 left_out =
        leftOut(tip, fit.covariance, touches[i], fit.weights.empty() ? 1.0 : fit.weights[i], sigma_mm);
    quick.left_out_mm[i] = {left_out * sigma_mm};
    errors.push_back(glm::length(left_out));
    left_mm.push_back(glm::distance(tip.tip_W_mm, touches[i].target_W.mm));
  }
  quick.median_mm = medianOf(left_mm);

  const double middle = medianOf(errors);
  std::vector<double> spread;
  for (const double error : errors) spread.push_back(std::abs(error - middle));
  const double limit = std::max(kMinDoubt, middle + kDoubt * 1.4826 * medianOf(spread));
  for (std::size_t i = 0; i < errors.size(); ++i) quick.doubtful[i] = errors[i] > limit;
  return quick;
}

}  // namespace calibration
