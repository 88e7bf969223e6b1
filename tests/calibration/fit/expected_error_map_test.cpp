#include "calibration/fit/expected_error_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/fit/rigid_fit.h"

namespace calibration {
namespace {

std::vector<Point<World>> corners() {
  std::vector<Point<World>> corners;
  for (const double x : {-65.0, 65.0})
    for (const double y : {-45.0, 45.0})
      for (const double z : {-30.0, 30.0}) corners.push_back({{x + 10.0, y, z}});
  return corners;
}

TEST(ExpectedErrorMap, IsSmallestAtTheCentre) {
  const ExpectedErrorMap map(corners(), 0.5);
  EXPECT_NEAR(map.at_mm({{10.0, 0.0, 0.0}}), 0.5 / std::sqrt(8.0), 1e-12);
  EXPECT_GT(map.at_mm({{75.0, 45.0, 30.0}}), map.at_mm({{10.0, 45.0, 0.0}}));
}

TEST(ExpectedErrorMap, AgreesWithRigidFitsOfNoisyTouches) {
  std::mt19937 rng(9);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<glm::dvec3> from, to(8);
  for (const auto& corner : corners()) from.push_back(corner.mm);
  std::vector<PointPair> pairs(8);
  const glm::dvec3 position(90.0, 60.0, -40.0);
  double sum = 0.0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (std::size_t i = 0; i < 8; ++i) pairs[i] = {from[i] + glm::dvec3(noise(rng), noise(rng), noise(rng)), from[i]};
    const glm::dvec3 error = (*rigidFit(pairs))(position)-position;
    sum += glm::dot(error, error);
  }
  const ExpectedErrorMap map(corners(), 0.3 * std::sqrt(3.0));
  EXPECT_NEAR(map.at_mm({position}) / std::sqrt(sum / kTrials), 1.0, 0.05);
}

}  // namespace
}  // namespace calibration
