#include "calibration/fit/rigid_fit.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <random>

namespace calibration {
namespace {

/// Places in a block, turned and moved; `mirrored`: their first coordinate turned over before.
struct Laid {
  std::vector<glm::dvec3> from, to;
  std::vector<std::size_t> all;
  glm::dquat turn{glm::angleAxis(2.9, glm::normalize(glm::dvec3(1.0, 3.0, -2.0)))};
  glm::dvec3 shift{12.0, -30.0, 7.0};
  std::mt19937 chance{8};

  explicit Laid(std::size_t n, bool mirrored = false) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
      from.push_back({65.0 * unit(chance), 45.0 * unit(chance), 30.0 * unit(chance)});
      to.push_back(turn * (from[i] * glm::dvec3(mirrored ? -1.0 : 1.0, 1.0, 1.0)) + shift);
      all.push_back(i);
    }
  }
};

TEST(RigidFit, FindsTurnAndShift) {
  const Laid laid(6);
  const auto map = rigidFit(laid.from, laid.to, laid.all);
  ASSERT_TRUE(map);
  EXPECT_NEAR(glm::determinant(map->turn), 1.0, 1e-12);
  EXPECT_LT(glm::distance((*map)({1.0, 2.0, 3.0}), laid.turn * glm::dvec3(1.0, 2.0, 3.0) + laid.shift), 1e-9);
}

TEST(RigidFit, KeepsTheHandednessItIsAskedFor) {
  const Laid laid(6, true);
  const auto kept = rigidFit(laid.from, laid.to, laid.all),
             mirrored = rigidFit(laid.from, laid.to, laid.all, Handedness::mirrored);
  ASSERT_TRUE(kept && mirrored);
  EXPECT_NEAR(glm::determinant(kept->turn), 1.0, 1e-12);
  EXPECT_NEAR(glm::determinant(mirrored->turn), -1.0, 1e-12);
  EXPECT_LT(glm::distance((*mirrored)(laid.from[2]), laid.to[2]), 1e-9);
}

TEST(RigidFit, TakesThreePlacesButNotALine) {
  const Laid laid(3);
  EXPECT_TRUE(rigidFit(laid.from, laid.to, laid.all));
  const std::vector<glm::dvec3> line = {{0, 0, 0}, {10, 0, 0}, {50, 0, 0}};
  EXPECT_FALSE(rigidFit(line, laid.to, laid.all));
}

TEST(RigidAgreement, FindsWhoAgrees) {
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
  std::shuffle(laid.to.begin(), laid.to.end(), laid.chance);
  EXPECT_FALSE(rigidAgreement(laid.from, laid.to, Handedness::kept, 2.5, 13.0));
  const Laid mirrored(27, true);
  EXPECT_FALSE(rigidAgreement(mirrored.from, mirrored.to, Handedness::kept, 2.5, 13.0));
  EXPECT_TRUE(rigidAgreement(mirrored.from, mirrored.to, Handedness::mirrored, 2.5, 13.0));
}

TEST(RigidAgreement, WidensItsLimitForAnUntrueArm) {
  Laid laid(27);
  std::normal_distribution<double> bent(0.0, 2.5);
  for (glm::dvec3& p : laid.to) p += glm::dvec3(bent(laid.chance), bent(laid.chance), bent(laid.chance));
  const auto agreement = rigidAgreement(laid.from, laid.to, Handedness::kept, 2.5, 13.0);
  ASSERT_TRUE(agreement);
  EXPECT_GT(agreement->limit_mm, 5.0);
  EXPECT_GE(agreement->agreeing.size(), 25u);
}

}  // namespace
}  // namespace calibration
