#include "calibration/fit/least_squares.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

namespace calibration {
namespace {

using Eigen::Index, Eigen::VectorXd, Eigen::MatrixXd;

constexpr double kFirstDamping = 1e-4, kLargestDamping = 1e16;
constexpr double kNothing = 1e-28;  ///< a cost below this share of a residual is zero

std::span<double> spanOf(VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<const double> spanOf(const VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

/// None: not positive definite, up to rounding.
std::optional<Eigen::LLT<MatrixXd>> factored(const MatrixXd& matrix) {
  Eigen::LLT<MatrixXd> factor(matrix);
  const Eigen::ArrayXd pivots = factor.matrixLLT().diagonal().array().square();
  const bool definite =
      factor.info() == Eigen::Success && pivots.allFinite() && (pivots > 1e-15 * matrix.diagonal().array().abs()).all();
  return definite ? std::optional(std::move(factor)) : std::nullopt;
}

/// Residuals, weights, cost and normal equations at one point.
class Linearised {
 public:
  explicit Linearised(const LeastSquares& problem)
      : problem_(problem),
        r_(static_cast<Index>(problem.residuals)),
        row_weight_(VectorXd::Ones(r_.size())),
        jacobian_(r_.size(), static_cast<Index>(problem.start.size())),
        prior_middle_(VectorXd::Zero(jacobian_.cols())),
        prior_information_(prior_middle_) {
    assert(problem.jacobian_at);
    assert(problem.priors.empty() || problem.priors.size() == problem.start.size());
    Index k = 0;
    for (const LeastSquares::Prior& prior : problem.priors) {
      prior_middle_[k] = prior.middle;
      prior_information_[k++] = prior.sigma > 0.0 ? 1.0 / (prior.sigma * prior.sigma) : 0.0;
    }
  }

  /// Half the sum of kernels; NaN where the residuals are undefined.
  double costAt(const VectorXd& x) {
    problem_.residuals_at(spanOf(x), spanOf(r_));
    double twice = prior_information_.dot((x - prior_middle_).cwiseAbs2());
    if (problem_.groups.empty()) twice += r_.squaredNorm();
    Index row = 0;
    for (const LeastSquares::Group& group : problem_.groups) {
      const auto rows = static_cast<Index>(group.residuals);
      const double s = r_.segment(row, rows).squaredNorm(), c2 = group.cauchy * group.cauchy;
      twice += c2 > 0.0 ? c2 * std::log1p(s / c2) : s;
      row_weight_.segment(row, rows).setConstant(c2 > 0.0 ? 1.0 / (1.0 + s / c2) : 1.0);
      row += rows;
    }
    return 0.5 * twice;
  }

  /// At the point of the last costAt().
  void linearise(const VectorXd& x) {
    jacobian_.setZero();
    problem_.jacobian_at(spanOf(x), {jacobian_.data(), static_cast<std::size_t>(jacobian_.size())});
    const MatrixXd weighed = row_weight_.asDiagonal() * jacobian_;
    information_.noalias() = jacobian_.transpose() * weighed;
    slope_ = weighed.transpose() * r_ + prior_information_.cwiseProduct(x - prior_middle_);
    curvature_ = information_;
    curvature_.diagonal() += prior_information_;
  }

  const MatrixXd& information() const { return information_; }  ///< J^T W J
  const MatrixXd& curvature() const { return curvature_; }      ///< with priors
  const VectorXd& slope() const { return slope_; }              ///< with priors
  const VectorXd& rowWeights() const { return row_weight_; }

 private:
  const LeastSquares& problem_;
  VectorXd r_, row_weight_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian_;
  VectorXd prior_middle_, prior_information_, slope_;
  MatrixXd information_, curvature_;
};

/// -(curvature + damping of its diagonal)^-1 slope. None: not positive definite.
std::optional<VectorXd> dampedStep(const Linearised& at, double damping) {
  MatrixXd matrix = at.curvature();
  const VectorXd own = matrix.diagonal();
  matrix.diagonal() += damping * own.cwiseMax(1e-12 * own.maxCoeff());
  const auto factor = factored(matrix);
  if (!factor) return std::nullopt;
  return VectorXd(-factor->solve(at.slope()));
}

/// Decrease predicted by the quadratic model.
double promised(const Linearised& at, const VectorXd& step) {
  return -step.dot(at.slope() + 0.5 * (at.curvature() * step));
}

void describeCertainty(const LeastSquares& problem, const Linearised& at, LeastSquaresResult& result) {
  Index row = 0;
  for (const LeastSquares::Group& group : problem.groups) {
    result.weights.push_back(group.residuals ? at.rowWeights()[row] : 1.0);
    row += static_cast<Index>(group.residuals);
  }
  const auto factor = factored(at.curvature());
  if (!factor) return;
  const MatrixXd covariance = factor->solve(MatrixXd::Identity(at.curvature().rows(), at.curvature().cols()));
  result.covariance.assign(covariance.data(), covariance.data() + covariance.size());
  result.effective_parameters = covariance.cwiseProduct(at.information()).sum();
}

}  // namespace

LeastSquaresResult solved(const LeastSquares& problem) {
  LeastSquaresResult result;
  VectorXd parameters = VectorXd::Map(problem.start.data(), static_cast<Index>(problem.start.size()));
  result.parameters = problem.start;
  Linearised at(problem);
  result.cost = at.costAt(parameters);
  if (!std::isfinite(result.cost)) return result;
  const double zero_cost = kNothing * static_cast<double>(problem.residuals + 1);

  double damping = kFirstDamping, growth = 2.0;
  while (result.iterations < problem.max_iterations && !result.converged) {
    at.linearise(parameters);
    ++result.iterations;
    // Increase damping until a step lowers the cost.
    for (bool better = false; !better && !result.converged;) {
      const auto step = dampedStep(at, damping);
      const double gain_promised = step ? promised(at, *step) : 0.0;
      const double cost = step ? at.costAt(parameters + *step) : result.cost;
      const double gain = result.cost - cost;
      better = std::isfinite(cost) && gain > 0.0;
      if (better) {
        const double kept = gain / std::max(gain_promised, gain * 1e-3);
        damping = std::max(1e-15, damping * std::clamp(1.0 - std::pow(2.0 * kept - 1.0, 3), 1.0 / 3.0, 2.0));
        growth = 2.0;
        result.converged = gain <= problem.relative_tolerance * result.cost || cost <= zero_cost;
        parameters += *step;
        result.cost = cost;
      } else {
        // No decrease possible, or no usable step.
        result.converged = step && gain_promised <= std::max(problem.relative_tolerance * result.cost, zero_cost);
        damping *= growth;
        growth *= 2.0;
        if (damping > kLargestDamping) result.converged = true;
      }
    }
  }
  at.costAt(parameters);
  at.linearise(parameters);
  describeCertainty(problem, at, result);
  result.parameters.assign(parameters.begin(), parameters.end());
  return result;
}

}  // namespace calibration
