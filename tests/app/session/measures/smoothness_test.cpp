#include "app/session/measures/smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace app {
namespace {

/// The speed of `reaches` minimum-jerk movements of a second one after the other.
std::vector<double> minimumJerk(int reaches, double dt_s = 1e-3) {
  std::vector<double> speed;
  const int ticks = static_cast<int>(std::lround(reaches / dt_s));
  for (int n = 0; n <= ticks; ++n) {
    const double t = std::fmod(n * dt_s, 1.0);
    speed.push_back(30.0 * t * t * (1.0 - t) * (1.0 - t) * 50.0);
  }
  return speed;
}

TEST(Smoothness, DimensionlessJerkOfAMinimumJerkReachIsItsClosedForm) {
  // 30 t^2 (1-t)^2: the integral of the squared second derivative is 720, the peak 1.875.
  EXPECT_NEAR(*logDimensionlessJerk(minimumJerk(1), 1e-3), -std::log(720.0 / (1.875 * 1.875)), 0.01);
  EXPECT_NEAR(*logDimensionlessJerk(minimumJerk(1), 1e-3), -5.322, 0.01);
}

TEST(Smoothness, DimensionlessJerkDependsNeitherOnSizeNorOnDuration) {
  std::vector<double> large = minimumJerk(1);
  for (double& value : large) value *= 7.0;
  EXPECT_NEAR(*logDimensionlessJerk(large, 1e-3), *logDimensionlessJerk(minimumJerk(1), 1e-3), 1e-9);
  EXPECT_NEAR(*logDimensionlessJerk(minimumJerk(1), 3e-3), *logDimensionlessJerk(minimumJerk(1), 1e-3), 1e-9);
}

TEST(Smoothness, SpectralArcLengthOfReachesIsThePublishedOne) {
  EXPECT_NEAR(*spectralArcLength(minimumJerk(1), 1e-3), -1.40, 0.02);
  EXPECT_NEAR(*spectralArcLength(minimumJerk(2), 1e-3), -2.25, 0.05);
  EXPECT_NEAR(*spectralArcLength(minimumJerk(5), 1e-3), -3.36, 0.2);
}

TEST(Smoothness, SpectralArcLengthHardlyDependsOnTheRate) {
  EXPECT_NEAR(*spectralArcLength(minimumJerk(1, 1e-2), 1e-2), *spectralArcLength(minimumJerk(1), 1e-3), 0.05);
}

TEST(Smoothness, TremorOfTenHertzIsAllOfItAndOfThreeNone) {
  const auto wave = [](double f_Hz) {
    std::vector<double> speed;
    for (int n = 0; n < 1000; ++n) speed.push_back(20.0 + 5.0 * std::sin(2.0 * std::numbers::pi * f_Hz * n * 1e-3));
    return speed;
  };
  EXPECT_GT(*tremorShare(wave(10.0), 1e-3), 0.99);
  EXPECT_LT(*tremorShare(wave(3.0), 1e-3), 0.01);
}

TEST(Smoothness, WithoutMovementThereIsNone) {
  const std::vector<double> rest(1000, 0.0), three(3, 1.0);
  EXPECT_FALSE(logDimensionlessJerk(rest, 1e-3));
  EXPECT_FALSE(spectralArcLength(rest, 1e-3));
  EXPECT_FALSE(tremorShare(rest, 1e-3));
  EXPECT_FALSE(logDimensionlessJerk(three, 1e-3));
  EXPECT_FALSE(spectralArcLength(three, 1e-3));
  EXPECT_FALSE(tremorShare(std::vector<double>(100, 1.0), 1e-3)) << "a tenth of a second";
}

}  // namespace
}  // namespace app
