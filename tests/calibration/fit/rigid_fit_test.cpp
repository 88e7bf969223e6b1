#include "calibration/fit/rigid_fit.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <random>

namespace calibration {
namespace {

/// Points in a block, rotated and moved; `mirrored`: the first coordinate negated before.
struct Laid {
  std::vector<glm::dvec3> from, to;
  std::vector<std::size_t> all;
  glm::dquat rotation{glm::angleAxis(2.9, glm::normalize(glm::dvec3(1.0, 3.0, -2.0)))};
  glm::dvec3 shift{12.0, -30.0, 7.0};
  std::mt19937 rng{8};

  explicit Laid(std::size_t n, bool mirrored = false) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
      from.push_back({65.0 * unit(rng), 45.0 * unit(rng), 30.0 * unit(rng)});
      to.push_back(rotation * (from[i] * glm::dvec3(mirrored ? -1.0 : 1.0, 1.0, 1.0)) + shift);
      all.push_back(i);
    }
  }
  std::vector<PointPair> pairs() const {
    std::vector<PointPair> pairs;
    for (const std::size_t i : all) pairs.push_back({to[i], from[i]});
    return pairs;
  }
};

TEST(RigidFit, FindsRotationAndTranslation) {
  const Laid laid(6);
  const auto map = rigidFit(laid.pairs());
  ASSERT_TRUE(map);
  EXPECT_NEAR(glm::determinant(map->rotation), 1.0, 1e-12);
  EXPECT_LT(glm::distance((*map)({1.0, 2.0, 3.0}), laid.rotation * glm::dvec3(1.0, 2.0, 3.0) + laid.shift), 1e-9);
}

TEST(RigidFit, KeepsTheRequestedHandedness) {
  const Laid laid(6, true);
  const auto kept = rigidFit(laid.pairs()), mirrored = rigidFit(laid.pairs(), Handedness::mirrored);
  ASSERT_TRUE(kept && mirrored);
  EXPECT_NEAR(glm::determinant(kept->rotation), 1.0, 1e-12);
  EXPECT_NEAR(glm::determinant(mirrored->rotation), -1.0, 1e-12);
  EXPECT_LT(glm::distance((*mirrored)(laid.from[2]), laid.to[2]), 1e-9);
}

TEST(RigidFit, AcceptsThreePointsButNotALine) {
  const Laid laid(3);
  EXPECT_TRUE(rigidFit(laid.pairs()));
  Laid line = laid;
  line.from = {{0, 0, 0}, {10, 0, 0}, {50, 0, 0}};
  EXPECT_FALSE(rigidFit(line.pairs()));
}

TEST(RigidFit, RecoversAnyRotationAndTranslation) {
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
    const auto map = rigidFit(pairs);
    ASSERT_TRUE(map);
    EXPECT_GT(std::abs(glm::dot(glm::quat_cast(map->rotation), R)), 1.0 - 1e-12);
    EXPECT_LT(glm::distance(map->translation_mm, t), 1e-8);
  }
}

TEST(RigidFit, NeverMirrors) {
  // Points of a plane, mirrored: the best rotation is still a rotation.
  const std::vector<PointPair> pairs = {
      {{-1, 0, 0}, {1, 0, 0}}, {{0, 2, 0}, {0, 2, 0}}, {{0, 0, 3}, {0, 0, 3}}, {{-1, 1, 1}, {1, 1, 1}}};
  EXPECT_NEAR(glm::determinant(rigidFit(pairs)->rotation), 1.0, 1e-12);
}

TEST(RigidFit, WeightsItsPairs) {
  const std::vector<PointPair> pairs = {
      {{0, 0, 0}, {0, 0, 0}, 1000.0}, {{11, 0, 0}, {10, 0, 0}}, {{0, 11, 0}, {0, 10, 0}}};
  EXPECT_LT(glm::length(rigidFit(pairs)->translation_mm), 0.05);
}

TEST(RigidAgreement, FindsTheAgreeingPoints) {
  for (const std::size_t n : {std::size_t{8}, std::size_t{27}, std::size_t{64}}) {
    Laid laid(n);
    laid.to[1] += glm::dvec3(5.0, 0.0, 0.0);
    laid.to[5] += glm::dvec3(0.0, -15.0, 8.0);
    const auto agreement = rigidAgreement(laid.from, laid.to, Handedness::kept, 2.5, 13.0);
    ASSERT_TRUE(agreement);
    std::vector<std::size_t> expected = laid.all;
    expected.erase(expected.begin() + 5);
    expected.erase(expected.begin() + 1);
    EXPECT_EQ(agreement->agreeing, expected);
    EXPECT_LT(agreement->rms_mm, 1e-9);
  }
}

TEST(RigidAgreement, IsNoneWhereNothingFits) {
  Laid laid(27);
  std::shuffle(laid.to.begin(), laid.to.end(), laid.rng);
  EXPECT_FALSE(rigidAgreement(laid.from, laid.to, Handedness::kept, 2.5, 13.0));
  const Laid mirrored(27, true);
  EXPECT_FALSE(rigidAgreement(mirrored.from, mirrored.to, Handedness::kept, 2.5, 13.0));
  EXPECT_TRUE(rigidAgreement(mirrored.from, mirrored.to, Handedness::mirrored, 2.5, 13.0));
}

TEST(RigidAgreement, WidensItsLimitForAPerturbedArm) {
  Laid laid(27);
  std::normal_distribution<double> bent(0.0, 2.5);
  for (glm::dvec3& p : laid.to) p += glm::dvec3(bent(laid.rng), bent(laid.rng), bent(laid.rng));
  const auto agreement = rigidAgreement(laid.from, laid.to, Handedness::kept, 2.5, 13.0);
  ASSERT_TRUE(agreement);
  EXPECT_GT(agreement->limit_mm, 5.0);
  EXPECT_GE(agreement->agreeing.size(), 25u);
}

}  // namespace
}  // namespace calibration
