#include "assets/import/mandibular_canal_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "assets/tissue.h"
#include "tests/assets/import/distance_to_line.h"
#include "tests/mutants.h"

namespace {

using assets::mandibularCanalLine;
using assets::VolumeGrid;

constexpr auto kCanal = static_cast<std::uint8_t>(assets::Tissue::mandibular_canal);

/// Labels a tube about the curve p(t), t in 0..1, where `present(t)`.
void addTube(
    const VolumeGrid& grid, std::vector<std::uint8_t>& label, double radius_mm,
    const std::function<glm::dvec3(double)>& curve,
    const std::function<bool(double)>& present = [](double) { return true; }) {
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const glm::dvec3 p = grid.centre_P_mm({i, j, k});
        double nearest = std::numeric_limits<double>::infinity();
        double at = 0.0;
        for (int s = 0; s <= 80; ++s) {
          const double distance = glm::distance(p, curve(s / 80.0));
          if (distance < nearest) {
            nearest = distance;
            at = s / 80.0;
          }
        }
        if (nearest <= radius_mm && at > 0.0 && at < 1.0 && present(at)) label[grid.index({i, j, k})] = kCanal;
      }
}

// A quarter of a circle of 20 mm, from anterior to superior, as the canal rises into the ramus.
glm::dvec3 quarter(double t) {
  const double angle = t * std::acos(0.0);
  return {10.0 + 3.0 * t, 20.0 * std::sin(angle) + 3.0, 24.0 - 20.0 * std::cos(angle)};
}

TEST(MandibularCanalLine, FollowsTheMiddleOfACurvedTube) {
  for (const double spacing_mm : {0.5, 0.8}) {
    const VolumeGrid grid{glm::ivec3(glm::dvec3(28.0 / spacing_mm)), spacing_mm, {0, 0, 0}};
    std::vector<std::uint8_t> label(grid.voxelCount(), 0);
    addTube(grid, label, 1.5, quarter);
    const auto canal = mandibularCanalLine(grid, label, std::nullopt);
    ASSERT_TRUE(canal);
    for (double t = 0.01; t < 1.0; t += 0.01)
      EXPECT_LT(tests::distanceToLine(canal->line_P_mm, quarter(t)), t > 0.06 && t < 0.94 ? 0.25 : 0.5) << t;
    EXPECT_NEAR(canal->radius_mm, 1.5, 0.12);
    EXPECT_LT(glm::distance(canal->line_P_mm.front(), quarter(0.0)), 0.8);
    EXPECT_LT(glm::distance(canal->line_P_mm.back(), quarter(1.0)), 0.8);
    for (std::size_t p = 1; p < canal->line_P_mm.size(); ++p)
      EXPECT_NEAR(glm::distance(canal->line_P_mm[p - 1], canal->line_P_mm[p]), 0.97, 0.1);
  }
}

TEST(MandibularCanalLine, ContinuesAcrossAGap) {
  const VolumeGrid grid{glm::ivec3(56), 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  addTube(grid, label, 1.5, quarter, [](double t) { return std::abs(t - 0.5) > 0.07; });
  const auto canal = mandibularCanalLine(grid, label, std::nullopt);
  ASSERT_TRUE(canal);
  EXPECT_LT(tests::distanceToLine(canal->line_P_mm, quarter(0.1)), 0.3);
  EXPECT_LT(tests::distanceToLine(canal->line_P_mm, quarter(0.5)), 0.3);
  EXPECT_LT(tests::distanceToLine(canal->line_P_mm, quarter(0.9)), 0.3);
  EXPECT_NEAR(canal->radius_mm, 1.5, 0.15);
}

/// A root covers labels of the canal: the line passes next to it.
TEST(MandibularCanalLine, PassesARootThatCoversItsLabels) {
  const VolumeGrid grid{{60, 100, 50}, 0.4, {0, 0, 0}};
  // Straight, then a 3 mm detour around the root, like a displaced canal.
  const auto course = [](double t) {
    const double y = 2.0 + 36.0 * t, bow = std::exp(-std::pow((y - 20.0) / 5.0, 2.0));
    return glm::dvec3(12.0 + 2.2 * bow, y, 10.0 - 1.5 * bow);
  };
  for (const double clearance_mm : {0.0, 0.4}) {
    std::vector<std::uint8_t> label(grid.voxelCount(), 0);
    // Labels are lost where the root lies within 1.5 mm of the canal's wall.
    addTube(grid, label, 1.4, course, [](double t) { return std::abs(36.0 * t - 18.0) > 3.5; });
    const glm::dvec3 aside = glm::normalize(glm::dvec3(-2.2, 0.0, 1.5));
    const glm::dvec3 root = course(0.5) + (1.4 + clearance_mm + 2.0) * aside;
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) {
          const glm::dvec3 p = grid.centre_P_mm({i, j, k}) - root;
          // A root of 2 mm radius with a rounded tip.
          const glm::dvec3 q(p.x, p.y, std::min(p.z, 0.0));
          if (glm::length(q) < 2.0) label[grid.index({i, j, k})] = static_cast<std::uint8_t>(assets::Tissue::dentine);
        }
    const auto canal = mandibularCanalLine(grid, label, std::nullopt);
    ASSERT_TRUE(canal);
    double farthest_mm = 0.0;
    for (double t = 0.1; t < 0.9; t += 0.01)
      farthest_mm = std::max(farthest_mm, tests::distanceToLine(canal->line_P_mm, course(t)));
    RecordProperty("farthest_mm", std::to_string(farthest_mm));
    EXPECT_LT(farthest_mm, 0.5) << clearance_mm;
    for (const glm::dvec3& p : canal->line_P_mm)
      EXPECT_GT(glm::length(glm::dvec3(p.x - root.x, p.y - root.y, std::min(p.z - root.z, 0.0))), 2.0 + 1.4 - 0.3);
  }
}

/// Noise labels all over the volume: bounded time, same canal.
TEST(MandibularCanalLine, HasBoundedTimeForNoisyLabels) {
  const VolumeGrid grid{glm::ivec3(160), 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  std::mt19937 random(3);
  for (int n = 0; n < 40000; ++n) label[random() % label.size()] = kCanal;
  for (int j = 10; j < 150; ++j)
    for (int k = -3; k <= 3; ++k)
      for (int i = -3; i <= 3; ++i)
        if (i * i + k * k <= 9) label[grid.index({80 + i, j, 80 + k})] = kCanal;
  const mutants::HangWatch watch;
  const auto canal = mandibularCanalLine(grid, label, glm::dvec3(40, 40, 45));
  ASSERT_TRUE(canal);
  EXPECT_LT(tests::distanceToLine(canal->line_P_mm, {40, 40, 40}), 1.5);
}

/// Oblique sheets 9 mm apart: their boxes overlap, but no pair is near enough to be joined.
TEST(MandibularCanalLine, HasBoundedTimeForLargeParts) {
  const VolumeGrid grid{glm::ivec3(125), 0.8, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  for (int k = 0; k < 125; ++k)
    for (int j = 0; j < 125; ++j)
      for (int i = 0; i < 125; ++i)
        if ((i + j) % 16 < 2) label[grid.index({i, j, k})] = kCanal;
  const mutants::HangWatch watch;
  EXPECT_TRUE(mandibularCanalLine(grid, label, glm::dvec3(50, 50, 50)));
}

TEST(MandibularCanalLine, TakesTheCanalNextToTheTooth) {
  const VolumeGrid grid{{70, 40, 20}, 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  const auto left = [](double t) { return glm::dvec3(30, 1 + 18 * t, 5); };
  const auto right = [](double t) { return glm::dvec3(5, 1 + 12 * t, 5); };
  addTube(grid, label, 1.5, left);
  addTube(grid, label, 1.5, right);
  EXPECT_NEAR(mandibularCanalLine(grid, label, glm::dvec3(8, 10, 8))->line_P_mm.front().x, 5.0, 0.15);
  EXPECT_NEAR(mandibularCanalLine(grid, label, glm::dvec3(28, 10, 8))->line_P_mm.front().x, 30.0, 0.15);
  EXPECT_NEAR(mandibularCanalLine(grid, label, std::nullopt)->line_P_mm.front().x, 30.0, 0.15);
}

TEST(MandibularCanalLine, IsNoneWithoutACanal) {
  const VolumeGrid grid{{20, 20, 20}, 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  EXPECT_FALSE(mandibularCanalLine(grid, label, std::nullopt));
  label[grid.index({10, 10, 10})] = kCanal;
  EXPECT_FALSE(mandibularCanalLine(grid, label, std::nullopt));
}

}  // namespace
