#include "calibration/fit/quick_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/least_squares.h"
#include "calibration/geometry/turn.h"
#include "calibration/median.h"

namespace calibration {
namespace {

// A turn and a shift of the base, offsets of six joints, the tip.
constexpr std::size_t kQuickNumbers = 15;
constexpr std::size_t kTurn = 0, kShift = 3, kOffset = 6, kTip = 12;
constexpr std::array<double, kQuickNumbers> kSigma = {0.1,   0.1,  0.1,  30.0, 30.0, 30.0, 0.015, 0.015,
                                                      0.015, 0.02, 0.02, 0.02, 1.0,  1.0,  1.0};
constexpr double kMismatch_mm = 0.3;  ///< what so few numbers can not say of an arm, an axis
constexpr double kCauchy = 3.0;
constexpr std::size_t kLeastTouches = 4;
constexpr double kDoubt = 3.0, kLeastDoubt = 4.5;  ///< robust sigmas; and sigmas of a touch, of which it is never less

MeasuredArm changed(MeasuredArm arm, std::span<const double> x) {
  arm.X_WD.rotation = glm::normalize(turnBy({x[kTurn], x[kTurn + 1], x[kTurn + 2]}) * arm.X_WD.rotation);
  for (int i = 0; i < 3; ++i) {
    arm.X_WD.translation_mm[i] += x[kShift + static_cast<std::size_t>(i)];
    arm.correction.tip_H_mm[i] += x[kTip + static_cast<std::size_t>(i)];
  }
  for (std::size_t i = 0; i < 6; ++i) arm.correction.offset_rad[i] += x[kOffset + i];
  return arm;
}

/// Of one touch, each axis over its sigma.
glm::dvec3 weighed(const MeasuredArm& arm, const Touch& touch, const glm::dvec3& sigma_mm) {
  return (arm.tip_W(touch.joints_rad).mm - touch.target_W.mm) / sigma_mm;
}

/// What is left at a touch when it had no say: (I - w J C J^T)^-1 r.
glm::dvec3 leftOut(const MeasuredArm& start, const LeastSquaresResult& fit, const Touch& touch, double weight,
                   const glm::dvec3& sigma_mm) {
  const glm::dvec3 left = weighed(changed(start, fit.numbers), touch, sigma_mm);
  if (fit.covariance.empty()) return left;
  std::array<glm::dvec3, kQuickNumbers> J;
  for (std::size_t k = 0; k < kQuickNumbers; ++k) {
    const double step = 1e-5 * kSigma[k];
    std::vector<double> more = fit.numbers, less = fit.numbers;
    more[k] += step;
    less[k] -= step;
    J[k] = (weighed(changed(start, more), touch, sigma_mm) - weighed(changed(start, less), touch, sigma_mm)) /
           (2.0 * step);
  }
  glm::dmat3 remains(1.0);
  for (std::size_t a = 0; a < kQuickNumbers; ++a)
    for (std::size_t b = 0; b < kQuickNumbers; ++b)
      remains -= weight * fit.covariance[a * kQuickNumbers + b] * glm::outerProduct(J[a], J[b]);
  return glm::determinant(remains) > 1e-9 ? glm::inverse(remains) * left : left;
}

}  // namespace

QuickFit quickFit(const MeasuredArm& start, const TouchSet& set) {
  QuickFit quick{start, {}, std::vector<bool>(set.touches.size(), false), 0.0};
  const std::vector<Touch>& touches = set.touches;
  const glm::dvec3 sigma_mm = touchSigma_mm(set.precision, kMismatch_mm);
  quick.left_out_mm.assign(touches.size(), {});
  if (touches.size() < kLeastTouches) return quick;

  LeastSquares problem;
  problem.start.assign(kQuickNumbers, 0.0);
  problem.residuals = 3 * touches.size();
  problem.residuals_at = [&](std::span<const double> x, std::span<double> r) {
    const MeasuredArm arm = changed(start, x);
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const glm::dvec3 left = weighed(arm, touches[i], sigma_mm);
      for (int axis = 0; axis < 3; ++axis) r[3 * i + static_cast<std::size_t>(axis)] = left[axis];
    }
  };
  for (const double sigma : kSigma) problem.priors.push_back({0.0, sigma});
  problem.groups.assign(touches.size(), {3, kCauchy});
  problem.most_iterations = 20;
  const LeastSquaresResult fit = solved(problem);
  quick.arm = changed(start, fit.numbers);

  // How far each is from where the others foretell it.
  std::vector<double> errors;
  std::vector<double> left_mm;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const double weight = i < fit.weights.size() ? fit.weights[i] : 1.0;
    const glm::dvec3 left_out = leftOut(start, fit, touches[i], weight, sigma_mm);
    quick.left_out_mm[i] = {left_out * sigma_mm};
    errors.push_back(glm::length(left_out));
    left_mm.push_back(glm::length(quick.arm.tip_W(touches[i].joints_rad).mm - touches[i].target_W.mm));
  }
  quick.median_mm = medianOf(left_mm);

  const double middle = medianOf(errors);
  std::vector<double> spread;
  for (const double error : errors) spread.push_back(std::abs(error - middle));
  const double limit = std::max(kLeastDoubt, middle + kDoubt * 1.4826 * medianOf(spread));
  for (std::size_t i = 0; i < errors.size(); ++i) quick.doubtful[i] = errors[i] > limit;
  return quick;
}

}  // namespace calibration
