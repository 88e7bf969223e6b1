#include "app/device/check/force_scale_fit.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(ForceScaleFit, FindsALineExactly) {
  const std::vector<ForceReading> readings = {{0.3, 0.37}, {0.6, 0.64}, {1.0, 1.0}, {-1.0, -0.8}};
  const ForceScaleFit fit = forceScale(readings);
  EXPECT_NEAR(fit.scale, 0.9, 1e-12);
  EXPECT_NEAR(fit.offset_N, 0.1, 1e-12);
  EXPECT_NEAR(fit.scale_error, 0.0, 1e-12);
  EXPECT_NEAR(fit.worst_N, 0.0, 1e-12);
}

TEST(ForceScaleFit, ReportsItsStandardError) {
  // Of many noisy weighings the scales scatter as the fits say.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  double squares = 0.0, said = 0.0;
  constexpr int kRuns = 2000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<ForceReading> readings;
    for (const double asked_N : {0.3, 0.6, 1.0, -0.3, -0.6, -1.0})
      readings.push_back({asked_N, 1.1 * asked_N + noise(random)});
    const ForceScaleFit fit = forceScale(readings);
    squares += (fit.scale - 1.1) * (fit.scale - 1.1) / kRuns;
    said += fit.scale_error * fit.scale_error / kRuns;
    ASSERT_GT(fit.worst_N, 0.0);
  }
  EXPECT_NEAR(std::sqrt(said) / std::sqrt(squares), 1.0, 0.05);
}

TEST(ForceScaleFit, ReadsGramsAsWeight) { EXPECT_NEAR(kGrams_per_N, 101.97, 0.01); }

}  // namespace
}  // namespace app
