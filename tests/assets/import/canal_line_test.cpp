#include "assets/import/canal_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "assets/tissue.h"

namespace {

using assets::canalLine;
using assets::VolumeGrid;

constexpr auto kCanal = static_cast<std::uint8_t>(assets::Tissue::canal);

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

double distanceToLine(const std::vector<glm::dvec3>& line, const glm::dvec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s + 1 < line.size(); ++s) {
    const glm::dvec3 segment = line[s + 1] - line[s];
    const double t = glm::clamp(glm::dot(p - line[s], segment) / glm::dot(segment, segment), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, line[s] + t * segment));
  }
  return nearest;
}

// A quarter of a circle of 20 mm, from anterior to superior, as the canal rises into the ramus.
glm::dvec3 quarter(double t) {
  const double angle = t * std::acos(0.0);
  return {10.0 + 3.0 * t, 20.0 * std::sin(angle) + 3.0, 24.0 - 20.0 * std::cos(angle)};
}

TEST(CanalLine, FollowsTheMiddleOfACurvedTube) {
  for (const double spacing_mm : {0.5, 0.8}) {
    const VolumeGrid grid{glm::ivec3(glm::dvec3(28.0 / spacing_mm)), spacing_mm, {0, 0, 0}};
    std::vector<std::uint8_t> label(grid.voxelCount(), 0);
    addTube(grid, label, 1.5, quarter);
    const auto canal = canalLine(grid, label, std::nullopt);
    ASSERT_TRUE(canal);
    for (double t = 0.01; t < 1.0; t += 0.01)
      EXPECT_LT(distanceToLine(canal->line_P_mm, quarter(t)), t > 0.06 && t < 0.94 ? 0.25 : 0.5) << t;
    EXPECT_NEAR(canal->radius_mm, 1.5, 0.12);
    EXPECT_LT(glm::distance(canal->line_P_mm.front(), quarter(0.0)), 0.8);
    EXPECT_LT(glm::distance(canal->line_P_mm.back(), quarter(1.0)), 0.8);
    for (std::size_t p = 1; p < canal->line_P_mm.size(); ++p)
      EXPECT_NEAR(glm::distance(canal->line_P_mm[p - 1], canal->line_P_mm[p]), 0.97, 0.1);
  }
}

TEST(CanalLine, GoesOnAcrossAGap) {
  const VolumeGrid grid{glm::ivec3(56), 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  addTube(grid, label, 1.5, quarter, [](double t) { return std::abs(t - 0.5) > 0.07; });
  const auto canal = canalLine(grid, label, std::nullopt);
  ASSERT_TRUE(canal);
  EXPECT_LT(distanceToLine(canal->line_P_mm, quarter(0.1)), 0.3);
  EXPECT_LT(distanceToLine(canal->line_P_mm, quarter(0.5)), 0.3);
  EXPECT_LT(distanceToLine(canal->line_P_mm, quarter(0.9)), 0.3);
  EXPECT_NEAR(canal->radius_mm, 1.5, 0.15);
}

TEST(CanalLine, TakesTheCanalBesideTheTooth) {
  const VolumeGrid grid{{70, 40, 20}, 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  const auto left = [](double t) { return glm::dvec3(30, 1 + 18 * t, 5); };
  const auto right = [](double t) { return glm::dvec3(5, 1 + 12 * t, 5); };
  addTube(grid, label, 1.5, left);
  addTube(grid, label, 1.5, right);
  EXPECT_NEAR(canalLine(grid, label, glm::dvec3(8, 10, 8))->line_P_mm.front().x, 5.0, 0.15);
  EXPECT_NEAR(canalLine(grid, label, glm::dvec3(28, 10, 8))->line_P_mm.front().x, 30.0, 0.15);
  EXPECT_NEAR(canalLine(grid, label, std::nullopt)->line_P_mm.front().x, 30.0, 0.15);
}

TEST(CanalLine, IsNoneWithoutACanal) {
  const VolumeGrid grid{{20, 20, 20}, 0.5, {0, 0, 0}};
  std::vector<std::uint8_t> label(grid.voxelCount(), 0);
  EXPECT_FALSE(canalLine(grid, label, std::nullopt));
  label[grid.index({10, 10, 10})] = kCanal;
  EXPECT_FALSE(canalLine(grid, label, std::nullopt));
}

}  // namespace
