#include "calibration/fit/kinematic_fit.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/arm_problem.h"

namespace calibration {
namespace {

constexpr double kCauchy = 5.0;  ///< of a touch, in sigmas: half weight there
/// Fraction of the mean square of three normal errors that these weights leave.
constexpr double kWeightsLeave = 0.842;
constexpr int kRounds = 12;
constexpr double kSettled = 0.02;  ///< relative change of the mismatch
// Prior of the mismatch: 0.15 mm within a factor of three; search range.
constexpr double kMismatchFactor = 3.0;
constexpr double kMinMismatch_mm = 1e-3, kMaxMismatch_mm = 10.0;

/// Most probable mismatch for these residuals, corrected for the fitted parameters. Golden section on a logarithmic
/// scale; the objective is unimodal.
double probableMismatch_mm(const std::vector<glm::dvec3>& errors_mm, const TouchPrecision& precision,
                           double effective_parameters) {
  const double left =
      kWeightsLeave * std::max(0.1, 1.0 - effective_parameters / static_cast<double>(3 * errors_mm.size()));
  const auto unlikely = [&](double log_mm) {
    const glm::dvec3 sigma = touchSigma_mm(precision, std::exp(log_mm));
    double sum = std::pow((log_mm - std::log(kUsualMismatch_mm)) / std::log(kMismatchFactor), 2);
    for (const glm::dvec3& error : errors_mm)
      for (int c = 0; c < 3; ++c) sum += std::pow(error[c] / sigma[c], 2) + 2.0 * left * std::log(sigma[c]);
    return sum;
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::log(kMinMismatch_mm), high = std::log(kMaxMismatch_mm);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = unlikely(a), at_b = unlikely(b);
  while (high - low > 0.005) {
    if (at_a < at_b)
      high = b, b = a, at_b = at_a, a = high - golden * (high - low), at_a = unlikely(a);
    else
      low = a, a = b, at_a = at_b, b = low + golden * (high - low), at_b = unlikely(b);
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

glm::dvec3 touchSigma_mm(const TouchPrecision& precision, double mismatch_mm) {
  const double in_plane = std::hypot(precision.in_plane_mm, mismatch_mm);
  return {in_plane, in_plane, std::hypot(precision.along_sight_mm, mismatch_mm)};
}

KinematicFit kinematicFit(const ArmStart& start, const std::vector<Touch>& touches, std::span<const std::size_t> which,
                          const TouchPrecision& precision, std::vector<std::size_t> parameters,
                          const KinematicFit* near) {
  KinematicFit fit;
  fit.fitted = std::move(parameters);
  if (near) fit.parameters = near->parameters;
  fit.mismatch_mm = near ? near->mismatch_mm : 2.0 * kUsualMismatch_mm;
  ArmProblem problem(start, touches, which, fit.fitted, kCauchy);
  LeastSquaresResult result;
  // Alternate: parameters at a mismatch, mismatch from their residuals.
  for (int round = 0; round < kRounds; ++round) {
    result = problem.solvedFrom(fit.parameters, touchSigma_mm(precision, fit.mismatch_mm));
    fit.parameters = problem.all(result.parameters);
    fit.iterations += result.iterations;
    fit.effective_parameters = result.effective_parameters;
    if (near) break;
    const MeasuredArm arm = armOf(start, fit.parameters);
    std::vector<glm::dvec3> errors_mm;
    for (std::size_t i = 0; i < which.size(); ++i)
      errors_mm.push_back(std::sqrt(result.weights[i]) *
                          (arm.tip_W(touches[which[i]].joints_rad).mm - touches[which[i]].target_W.mm));
    const double was_mm = fit.mismatch_mm;
    fit.mismatch_mm = probableMismatch_mm(errors_mm, precision, fit.effective_parameters);
    if (std::abs(fit.mismatch_mm - was_mm) < kSettled * was_mm) break;
  }
  fit.covariance = result.covariance;
  for (std::size_t i = 0; i < fit.fitted.size() && !fit.covariance.empty(); ++i)
    fit.sigma[fit.fitted[i]] = std::sqrt(fit.covariance[i * fit.fitted.size() + i]);
  return fit;
}

}  // namespace calibration
