#include "calibration/fit/least_squares.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

namespace calibration {
namespace {

/// With the Jacobian by central differences.
LeastSquaresResult solvedByDifferences(LeastSquares problem) {
  problem.jacobian_at = [&problem](std::span<const double> x, std::span<double> J) {
    constexpr double kStep = 1e-6;
    std::vector<double> moved(x.begin(), x.end()), above(problem.residuals), below(problem.residuals);
    for (std::size_t k = 0; k < x.size(); ++k) {
      moved[k] = x[k] + kStep;
      problem.residuals_at(moved, above);
      moved[k] = x[k] - kStep;
      problem.residuals_at(moved, below);
      moved[k] = x[k];
      for (std::size_t i = 0; i < problem.residuals; ++i) J[i * x.size() + k] = (above[i] - below[i]) / (2.0 * kStep);
    }
  };
  return solved(problem);
}

/// y = a + b t at ten points, measured with sigma 0.1.
struct Line {
  std::array<double, 10> t{}, y{};

  Line() {
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<double>(i), y[i] = 2.0 + 0.5 * t[i];
  }
  LeastSquares problem() const {
    LeastSquares line;
    line.start = {0.0, 0.0};
    line.residuals = t.size();
    line.residuals_at = [this](std::span<const double> x, std::span<double> r) {
      for (std::size_t i = 0; i < t.size(); ++i) r[i] = (x[0] + x[1] * t[i] - y[i]) / 0.1;
    };
    return line;
  }
};

LeastSquares rosenbrock() {
  LeastSquares valley;
  valley.start = {-1.2, 1.0};
  valley.residuals = 2;
  valley.residuals_at = [](std::span<const double> x, std::span<double> r) {
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
  };
  return valley;
}

/// A sum of two decays and a constant, noisy. OpenCV's solver needs a near start.
struct Decays {
  std::vector<double> y;
  Decays() {
    std::mt19937 rng(3);
    std::normal_distribution<double> noise(0.0, 0.01);
    for (int i = 0; i < 60; ++i) y.push_back(at({1.0, 0.5, 2.0, 0.05, 0.3}, i) + noise(rng));
  }
  static double at(const std::array<double, 5>& x, int i) {
    return x[0] * std::exp(-x[1] * i) + x[2] * std::exp(-x[3] * i) + x[4];
  }
  void residuals(const double* x, double* r) const {
    for (std::size_t i = 0; i < y.size(); ++i)
      r[i] = (at({x[0], x[1], x[2], x[3], x[4]}, static_cast<int>(i)) - y[i]) / 0.01;
  }
};

struct DecaysForOpenCv : cv::LMSolver::Callback {
  const Decays& decays;
  explicit DecaysForOpenCv(const Decays& d) : decays(d) {}
  bool compute(cv::InputArray param, cv::OutputArray err, cv::OutputArray J) const override {
    const cv::Mat x = param.getMat();
    cv::Mat r(static_cast<int>(decays.y.size()), 1, CV_64F);
    decays.residuals(x.ptr<double>(), r.ptr<double>());
    r.copyTo(err);
    if (!J.needed()) return true;
    cv::Mat jacobian(r.rows, 5, CV_64F), above = r.clone(), below = r.clone();
    for (int k = 0; k < 5; ++k) {
      cv::Mat moved = x.clone();
      moved.at<double>(k) += 1e-6;
      decays.residuals(moved.ptr<double>(), above.ptr<double>());
      moved.at<double>(k) -= 2e-6;
      decays.residuals(moved.ptr<double>(), below.ptr<double>());
      cv::Mat column = (above - below) / 2e-6;
      column.copyTo(jacobian.col(k));
    }
    jacobian.copyTo(J);
    return true;
  }
};

TEST(LeastSquares, FindsALineAndItsCovariance) {
  const Line line;
  const LeastSquaresResult found = solvedByDifferences(line.problem());
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.parameters[0], 2.0, 1e-9);
  EXPECT_NEAR(found.parameters[1], 0.5, 1e-9);
  // Textbook: var b = sigma^2 / sum (t - mean)^2, var a = sigma^2 (1/n + mean^2 / sum).
  ASSERT_EQ(found.covariance.size(), 4u);
  EXPECT_NEAR(found.covariance[3], 0.01 / 82.5, 1e-9);
  EXPECT_NEAR(found.covariance[0], 0.01 * (0.1 + 4.5 * 4.5 / 82.5), 1e-9);
  EXPECT_NEAR(found.effective_parameters, 2.0, 1e-6);
}

TEST(LeastSquares, DownWeightsAnOutlier) {
  Line line;
  line.y[7] += 15.0;
  LeastSquares problem = line.problem();
  EXPECT_GT(std::abs(solvedByDifferences(problem).parameters[0] - 2.0), 0.1);
  problem.groups.assign(10, {1, 2.0});
  const LeastSquaresResult found = solvedByDifferences(problem);
  EXPECT_NEAR(found.parameters[0], 2.0, 0.005);
  EXPECT_NEAR(found.parameters[1], 0.5, 0.005);
  EXPECT_LT(found.weights[7], 1e-3);
  EXPECT_GT(found.weights[2], 0.9);
}

TEST(LeastSquares, WeightsAGroupTogether) {
  // Two residuals of a group: the good one is down-weighted with the outlier.
  Line line;
  line.y[7] += 15.0;
  LeastSquares problem = line.problem();
  problem.groups.assign(5, {2, 2.0});
  const LeastSquaresResult found = solvedByDifferences(problem);
  ASSERT_EQ(found.weights.size(), 5u);
  EXPECT_LT(found.weights[3], 1e-3);
  EXPECT_NEAR(found.parameters[1], 0.5, 0.005);
}

TEST(LeastSquares, SolvesRosenbrock) {
  const LeastSquaresResult found = solvedByDifferences(rosenbrock());
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.iterations, 40);
  EXPECT_NEAR(found.parameters[0], 1.0, 1e-6);
  EXPECT_NEAR(found.parameters[1], 1.0, 1e-6);
}

TEST(LeastSquares, WeightsPriorAndMeasurementByTheirSigmas) {
  // One measurement 1.0 of sigma 0.5, prior 0 of sigma 0.25: 0.2, sigma of 1 / sqrt(4 + 16).
  LeastSquares one;
  one.start = {0.0};
  one.residuals = 1;
  one.residuals_at = [](std::span<const double> x, std::span<double> r) { r[0] = (x[0] - 1.0) / 0.5; };
  one.priors = {{0.0, 0.25}};
  const LeastSquaresResult found = solvedByDifferences(one);
  EXPECT_NEAR(found.parameters[0], 0.2, 1e-9);
  EXPECT_NEAR(found.covariance[0], 1.0 / 20.0, 1e-9);
  EXPECT_NEAR(found.effective_parameters, 0.2, 1e-9);
}

TEST(LeastSquares, LeavesAnUnobservedParameterAtItsPrior) {
  LeastSquares two = Line{}.problem();
  two.start = {0.0, 0.0};
  two.residuals = 1;
  two.residuals_at = [](std::span<const double> x, std::span<double> r) { r[0] = x[0] - 3.0; };
  EXPECT_TRUE(solvedByDifferences(two).covariance.empty());
  EXPECT_NEAR(solvedByDifferences(two).parameters[0], 3.0, 1e-6);
  two.priors = {{0.0, 0.0}, {7.0, 1.0}};
  const LeastSquaresResult found = solvedByDifferences(two);
  ASSERT_FALSE(found.covariance.empty());
  EXPECT_NEAR(found.parameters[0], 3.0, 1e-9);
  EXPECT_NEAR(found.parameters[1], 7.0, 1e-9);
}

TEST(LeastSquares, ShortensAStepOutOfTheDomain) {
  LeastSquares root;
  root.start = {100.0};
  root.residuals = 1;
  root.residuals_at = [](std::span<const double> x, std::span<double> r) {
    r[0] = x[0] > 0.0 ? std::log(x[0]) : std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_NEAR(solvedByDifferences(root).parameters[0], 1.0, 1e-6);
  root.start = {-1.0};
  EXPECT_FALSE(solvedByDifferences(root).converged);
}

TEST(LeastSquares, AgreesWithOpenCvsSolver) {
  const Decays decays;
  LeastSquares problem;
  problem.start = {0.9, 0.6, 1.9, 0.06, 0.25};
  problem.residuals = decays.y.size();
  problem.residuals_at = [&](std::span<const double> x, std::span<double> r) { decays.residuals(x.data(), r.data()); };
  const LeastSquaresResult found = solvedByDifferences(problem);
  EXPECT_TRUE(found.converged);

  cv::Mat x = (cv::Mat_<double>(5, 1) << 0.9, 0.6, 1.9, 0.06, 0.25);
  cv::LMSolver::create(cv::makePtr<DecaysForOpenCv>(decays), 200, 1e-12)->run(x);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(found.parameters[static_cast<std::size_t>(k)], x.at<double>(k), 1e-5);
}

}  // namespace
}  // namespace calibration
