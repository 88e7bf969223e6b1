#include "calibration/fit/least_squares.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace calibration {
namespace {

constexpr double kFirstDamping = 1e-4, kLargestDamping = 1e16;
constexpr double kDifference = 1e-6;
constexpr double kNothing = 1e-28;  ///< a cost below this share of a residual is zero

using Numbers = std::vector<double>;

/// The problem at one place: residuals, weights, cost; and its normal equations.
class Linearised {
 public:
  explicit Linearised(const LeastSquares& problem)
      : problem_(problem), n_(problem.start.size()), m_(problem.residuals), r_(m_), row_weight_(m_, 1.0) {
    assert(problem.priors.empty() || problem.priors.size() == n_);
  }

  /// Half the sum of kernels; NaN where the place can not be evaluated.
  double costAt(const Numbers& x) {
    problem_.residuals_at(x, r_);
    double twice = 0.0;
    std::size_t row = 0;
    if (problem_.groups.empty())
      for (const double r : r_) twice += r * r;
    for (const LeastSquares::Group& group : problem_.groups) {
      double s = 0.0;
      for (std::size_t i = 0; i < group.residuals; ++i) s += r_[row + i] * r_[row + i];
      const double c2 = group.cauchy * group.cauchy;
      twice += group.cauchy > 0.0 ? c2 * std::log1p(s / c2) : s;
      const double weight = group.cauchy > 0.0 ? 1.0 / (1.0 + s / c2) : 1.0;
      for (std::size_t i = 0; i < group.residuals; ++i) row_weight_[row++] = weight;
    }
    for (std::size_t k = 0; k < problem_.priors.size(); ++k) twice += std::pow(fromPrior(x, k), 2);
    return 0.5 * twice;
  }

  /// J^T W J without the priors, and the slope with them, at the place last asked the cost of.
  void linearise(const Numbers& x) {
    fillJacobian(x);
    information_.assign(n_ * n_, 0.0);
    slope_.assign(n_, 0.0);
    for (std::size_t row = 0; row < m_; ++row) {
      const double* J = &jacobian_[row * n_];
      for (std::size_t a = 0; a < n_; ++a) {
        const double weighted = row_weight_[row] * J[a];
        if (weighted == 0.0) continue;
        slope_[a] += weighted * r_[row];
        double* line = &information_[a * n_];
        for (std::size_t b = 0; b <= a; ++b) line[b] += weighted * J[b];
      }
    }
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b < n_; ++b) information_[a * n_ + b] = information_[b * n_ + a];
    for (std::size_t k = 0; k < problem_.priors.size(); ++k)
      slope_[k] += fromPrior(x, k) * std::sqrt(priorInformation(k));
  }

  double priorInformation(std::size_t k) const {
    if (problem_.priors.empty() || problem_.priors[k].sigma <= 0.0) return 0.0;
    return 1.0 / (problem_.priors[k].sigma * problem_.priors[k].sigma);
  }

  const Numbers& information() const { return information_; }
  const Numbers& slope() const { return slope_; }
  const Numbers& rowWeights() const { return row_weight_; }

 private:
  double fromPrior(const Numbers& x, std::size_t k) const {
    const LeastSquares::Prior& prior = problem_.priors[k];
    return prior.sigma > 0.0 ? (x[k] - prior.middle) / prior.sigma : 0.0;
  }

  void fillJacobian(const Numbers& x) {
    jacobian_.assign(m_ * n_, 0.0);
    if (problem_.jacobian_at) return problem_.jacobian_at(x, jacobian_);
    Numbers moved = x, above(m_), below(m_);
    for (std::size_t k = 0; k < n_; ++k) {
      const double step = kDifference * (priorInformation(k) > 0.0 ? problem_.priors[k].sigma : 1.0);
      moved[k] = x[k] + step;
      problem_.residuals_at(moved, above);
      moved[k] = x[k] - step;
      problem_.residuals_at(moved, below);
      moved[k] = x[k];
      for (std::size_t row = 0; row < m_; ++row) jacobian_[row * n_ + k] = (above[row] - below[row]) / (2.0 * step);
    }
  }

  const LeastSquares& problem_;
  std::size_t n_, m_;
  Numbers r_, row_weight_, jacobian_, information_, slope_;
};

/// The step -(information + priors + damping of its diagonal)^-1 slope. Empty: not positive definite.
Numbers dampedStep(const Linearised& at, std::size_t n, double damping) {
  Numbers matrix = at.information();
  double largest = 0.0;
  for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, matrix[k * n + k] + at.priorInformation(k));
  for (std::size_t k = 0; k < n; ++k) {
    const double own = matrix[k * n + k] + at.priorInformation(k);
    matrix[k * n + k] = own + damping * std::max(own, 1e-12 * largest);
  }
  if (!choleskyFactored(matrix, n)) return {};
  Numbers step = at.slope();
  choleskySolved(matrix, n, step);
  for (double& s : step) s = -s;
  return step;
}

/// What the quadratic model promises: -slope.step - step^T (information + priors) step / 2.
double promised(const Linearised& at, const Numbers& step) {
  const std::size_t n = step.size();
  double gain = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    double turned = at.priorInformation(a) * step[a];
    for (std::size_t b = 0; b < n; ++b) turned += at.information()[a * n + b] * step[b];
    gain -= step[a] * (at.slope()[a] + 0.5 * turned);
  }
  return gain;
}

void describeCertainty(const LeastSquares& problem, Linearised& at, LeastSquaresResult& result) {
  const std::size_t n = problem.start.size();
  std::size_t row = 0;
  for (const LeastSquares::Group& group : problem.groups) {
    result.weights.push_back(group.residuals ? at.rowWeights()[row] : 1.0);
    row += group.residuals;
  }
  Numbers factor = at.information();
  for (std::size_t k = 0; k < n; ++k) factor[k * n + k] += at.priorInformation(k);
  if (!choleskyFactored(factor, n)) return;
  result.covariance.assign(n * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const std::span<double> line(&result.covariance[k * n], n);
    line[k] = 1.0;
    choleskySolved(factor, n, line);
  }
  for (std::size_t i = 0; i < n * n; ++i) result.effective_numbers += result.covariance[i] * at.information()[i];
}

}  // namespace

LeastSquaresResult solved(const LeastSquares& problem) {
  const std::size_t n = problem.start.size();
  LeastSquaresResult result;
  result.numbers = problem.start;
  Linearised at(problem);
  result.cost = at.costAt(result.numbers);
  if (!std::isfinite(result.cost)) return result;
  const double zero_cost = kNothing * static_cast<double>(problem.residuals + 1);

  double damping = kFirstDamping, growth = 2.0;
  while (result.iterations < problem.most_iterations && !result.converged) {
    at.linearise(result.numbers);
    ++result.iterations;
    // Damping grows until a step is better than where it starts.
    for (bool better = false; !better && !result.converged;) {
      const Numbers step = dampedStep(at, n, damping);
      const double gain_promised = step.empty() ? 0.0 : promised(at, step);
      Numbers there = result.numbers;
      for (std::size_t k = 0; k < step.size(); ++k) there[k] += step[k];
      const double cost = step.empty() ? result.cost : at.costAt(there);
      const double gain = result.cost - cost;
      better = !step.empty() && std::isfinite(cost) && gain > 0.0;
      if (better) {
        const double kept = gain / std::max(gain_promised, gain * 1e-3);
        damping = std::max(1e-15, damping * std::clamp(1.0 - std::pow(2.0 * kept - 1.0, 3), 1.0 / 3.0, 2.0));
        growth = 2.0;
        result.converged = gain <= problem.good_enough * result.cost || cost <= zero_cost;
        result.numbers = there;
        result.cost = cost;
      } else {
        // Nothing left to gain, or no step that is any use.
        result.converged = !step.empty() && gain_promised <= std::max(problem.good_enough * result.cost, zero_cost);
        damping *= growth;
        growth *= 2.0;
        if (damping > kLargestDamping) result.converged = true;
      }
    }
  }
  at.costAt(result.numbers);
  at.linearise(result.numbers);
  describeCertainty(problem, at, result);
  return result;
}

bool choleskyFactored(std::span<double> matrix, std::size_t n) {
  for (std::size_t row = 0; row < n; ++row) {
    double* mine = &matrix[row * n];
    for (std::size_t column = 0; column <= row; ++column) {
      const double* other = &matrix[column * n];
      double sum = mine[column];
      for (std::size_t k = 0; k < column; ++k) sum -= mine[k] * other[k];
      if (column < row) {
        mine[column] = sum / other[column];
      } else {
        // A pivot that rounding alone could have left is none.
        if (!(sum > 1e-15 * std::abs(mine[row])) || !std::isfinite(sum)) return false;
        mine[row] = std::sqrt(sum);
      }
    }
  }
  return true;
}

void choleskySolved(std::span<const double> factor, std::size_t n, std::span<double> b) {
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t k = 0; k < row; ++k) b[row] -= factor[row * n + k] * b[k];
    b[row] /= factor[row * n + row];
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t k = row + 1; k < n; ++k) b[row] -= factor[k * n + row] * b[k];
    b[row] /= factor[row * n + row];
  }
}

}  // namespace calibration
