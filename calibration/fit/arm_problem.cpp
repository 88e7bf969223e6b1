#include "calibration/fit/arm_problem.h"

#include <cmath>

namespace calibration {

ArmProblem::ArmProblem(const ArmStart& start, const std::vector<Touch>& touches, std::span<const std::size_t> which,
                       std::span<const std::size_t> parameters, double cauchy)
    : start_(start), touches_(touches), which_(which), parameters_(parameters) {
  min_squares.residuals = 3 * which.size();
  min_squares.groups.assign(which.size(), {3, cauchy});
  for (const std::size_t k : parameters) min_squares.priors.push_back({0.0, kArmPriorSigma[k]});
  min_squares.residuals_at = [this](std::span<const double> x, std::span<double> r) { residuals(x, r); };
  min_squares.jacobian_at = [this](std::span<const double> x, std::span<double> J) { jacobian(x, J); };
}

LeastSquaresResult ArmProblem::solvedFrom(const ArmParameters& parameters, const glm::dvec3& sigma_mm) {
  sigma_mm_ = sigma_mm;
  min_squares.start.clear();
  for (const std::size_t k : parameters_) min_squares.start.push_back(parameters[k]);
  return solved(min_squares);
}

ArmParameters ArmProblem::all(std::span<const double> x) const {
  ArmParameters parameters{};
  for (std::size_t i = 0; i < parameters_.size(); ++i) parameters[parameters_[i]] = x[i];
  return parameters;
}

void ArmProblem::residuals(std::span<const double> x, std::span<double> r) const {
  const MeasuredArm arm = armOf(start_, all(x));
  for (std::size_t i = 0; i < which_.size(); ++i) {
    const Touch& touch = touches_[which_[i]];
    const glm::dvec3 error = (arm.tip_W(touch.joints_rad).mm - touch.target_W.mm) / sigma_mm_;
    for (int c = 0; c < 3; ++c) r[3 * i + static_cast<std::size_t>(c)] = error[c];
  }
}

void ArmProblem::jacobian(std::span<const double> x, std::span<double> J) const {
  const ArmParameters parameters = all(x);
  for (std::size_t i = 0; i < which_.size(); ++i) {
    const TipJacobian slopes = tipJacobian(start_, parameters, touches_[which_[i]].joints_rad);
    for (std::size_t k = 0; k < parameters_.size(); ++k)
      for (int c = 0; c < 3; ++c)
        J[(3 * i + static_cast<std::size_t>(c)) * parameters_.size() + k] =
            slopes.by_parameter[parameters_[k]][c] / sigma_mm_[c];
  }
}

double rms_mm(const MeasuredArm& arm, const std::vector<Touch>& touches, std::span<const std::size_t> which) {
  double sum = 0.0;
  for (const std::size_t i : which)
    sum += std::pow(glm::distance(arm.tip_W(touches[i].joints_rad).mm, touches[i].target_W.mm), 2);
  return std::sqrt(sum / static_cast<double>(which.size()));
}

}  // namespace calibration
