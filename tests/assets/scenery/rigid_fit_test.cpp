#include "assets/scenery/rigid_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace assets {
namespace {

TEST(RigidFit, RecoversAnyRotationAndShift) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    const glm::dquat R = glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
    const glm::dvec3 t(50.0 * normal(random), 50.0 * normal(random), 50.0 * normal(random));
    std::vector<PointPair> pairs;
    for (int n = 0; n < 6; ++n) {
      const glm::dvec3 p(20.0 * normal(random), 20.0 * normal(random), 20.0 * normal(random));
      pairs.push_back({R * p + t, p, 0.5 + n});
    }
    const RigidMotion X = rigidFit(pairs);
    EXPECT_GT(std::abs(glm::dot(X.rotation, R)), 1.0 - 1e-12);
    EXPECT_LT(glm::distance(X.translation_mm, t), 1e-8);
  }
}

TEST(RigidFit, NeverMirrors) {
  // Points of a plane, mirrored: the best rotation is still a rotation.
  const std::vector<PointPair> pairs = {
      {{-1, 0, 0}, {1, 0, 0}}, {{0, 2, 0}, {0, 2, 0}}, {{0, 0, 3}, {0, 0, 3}}, {{-1, 1, 1}, {1, 1, 1}}};
  const RigidMotion X = rigidFit(pairs);
  EXPECT_NEAR(glm::determinant(glm::mat3_cast(X.rotation)), 1.0, 1e-12);
}

TEST(RigidFit, WeighsItsPairs) {
  const std::vector<PointPair> pairs = {
      {{0, 0, 0}, {0, 0, 0}, 1000.0}, {{11, 0, 0}, {10, 0, 0}}, {{0, 11, 0}, {0, 10, 0}}};
  EXPECT_LT(glm::length(rigidFit(pairs).translation_mm), 0.05);
}

}  // namespace
}  // namespace assets
