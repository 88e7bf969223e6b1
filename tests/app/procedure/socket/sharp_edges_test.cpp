#include "app/procedure/socket/sharp_edges.h"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "assets/tissue.h"

namespace app {
namespace {

/// Solid by a signed distance, negative inside; all around it was opened.
struct Shape {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, label, opened;

  Shape(double voxel_mm, const std::function<double(const glm::dvec3&)>& distance_mm)
      : grid{glm::ivec3(static_cast<int>(16.0 / voxel_mm)), voxel_mm, glm::dvec3(-8.0 + 0.5 * voxel_mm)},
        solid(grid.voxelCount()),
        label(grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::cortical)),
        opened(grid.voxelCount(), 1) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double share = std::clamp(0.5 - distance_mm(grid.centre_P_mm(ijk)) / voxel_mm, 0.0, 1.0);
      solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * share));
    });
  }
  std::vector<SharpEdge> edges() const { return sharpEdges({grid, solid, label, opened}, {0.0, 0.0, 1.0}); }
};

double sum_mm(const std::vector<SharpEdge>& edges) {
  return std::accumulate(edges.begin(), edges.end(), 0.0,
                         [](double sum, const SharpEdge& edge) { return sum + edge.length_mm; });
}

/// A ridge along x, its flanks at this angle, from -6 to 6 mm.
double ridge_mm(const glm::dvec3& p, double angle_rad) {
  const double across = std::cos(0.5 * angle_rad) * std::abs(p.y) + std::sin(0.5 * angle_rad) * (p.z - 2.0);
  return std::max(across, std::abs(p.x) - 6.0);
}

constexpr double kDegree_rad = 3.14159265358979 / 180.0;

TEST(SharpEdges, FindsAnEdgeOfNinetyDegreesInItsLength) {
  for (const double voxel_mm : {0.2, 0.25, 0.3}) {
    const Shape shape(voxel_mm, [](const glm::dvec3& p) { return ridge_mm(p, 90.0 * kDegree_rad); });
    const std::vector<SharpEdge> edges = shape.edges();
    ASSERT_FALSE(edges.empty()) << voxel_mm;
    const SharpEdge& edge = edges.front();
    EXPECT_LT(edge.radius_mm, kSharp_mm);
    double longest_mm = 0.0;
    for (const glm::dvec3& p : edge.points_P_mm)
      if (std::abs(p.y) < 1.0 && p.z > 1.0) longest_mm = std::max(longest_mm, std::abs(p.x));
    EXPECT_NEAR(longest_mm, 6.0, 0.6) << voxel_mm;
  }
}

TEST(SharpEdges, ARidgeInBoneIsAsLongAsItIs) {
  // Its ends go on beyond the volume, so that it has no others.
  const Shape shape(0.25, [](const glm::dvec3& p) { return ridge_mm({0.0, p.y, p.z}, 90.0 * kDegree_rad); });
  EXPECT_NEAR(sum_mm(shape.edges()), 16.0, 1.0);
}

TEST(SharpEdges, LetsBluntEdgesAndRoundBoneBe) {
  const Shape blunt(0.25, [](const glm::dvec3& p) { return ridge_mm({0.0, p.y, p.z}, 140.0 * kDegree_rad); });
  EXPECT_TRUE(blunt.edges().empty());
  const Shape plane(0.25, [](const glm::dvec3& p) { return glm::dot(p, glm::normalize(glm::dvec3(0.3, -0.2, 1.0))); });
  EXPECT_TRUE(plane.edges().empty());
  const Shape rod(0.25, [](const glm::dvec3& p) { return std::hypot(p.y, p.z) - 1.5; });
  EXPECT_TRUE(rod.edges().empty());
}

TEST(SharpEdges, ANarrowRodIsSharpAsAWhole) {
  const Shape rod(0.2, [](const glm::dvec3& p) { return std::hypot(p.y, p.z) - 0.45; });
  EXPECT_GT(sum_mm(rod.edges()), 15.0);
}

TEST(SharpEdges, SingleVoxelsAreNone) {
  Shape shape(0.25, [](const glm::dvec3& p) { return p.z; });
  shape.solid[shape.grid.index({20, 30, 32})] = 255;
  shape.solid[shape.grid.index({40, 30, 33})] = 255;
  shape.solid[shape.grid.index({40, 44, 31})] = 0;
  EXPECT_TRUE(shape.edges().empty());
}

TEST(SharpEdges, WhatLiesDeepIsNotOfTheCrest) {
  // A step of 6 mm: its upper edge is, a ridge at its foot is not.
  const auto step = [](const glm::dvec3& p) {
    const double high = std::max(p.y, p.z - 4.0), low = p.z + 4.0,
                 ridge = std::max(std::abs(p.y - 1.5) - 0.6, p.z + 2.5);
    return std::min({high, low, ridge});
  };
  const Shape shape(0.25, step);
  for (const SharpEdge& edge : shape.edges())
    for (const glm::dvec3& p : edge.points_P_mm) EXPECT_GT(p.z, 2.0);
  EXPECT_GT(sum_mm(shape.edges()), 14.0);
}

TEST(SharpEdges, ThePatientsOwnEdgesAndTeethAreLetBe) {
  Shape shape(0.25, [](const glm::dvec3& p) { return ridge_mm({0.0, p.y, p.z}, 90.0 * kDegree_rad); });
  assets::forVoxels(shape.grid, [&](glm::ivec3 ijk, std::size_t v) {
    shape.opened[v] = shape.grid.centre_P_mm(ijk).x > 4.0 ? 1 : 0;
  });
  const double half_mm = sum_mm(shape.edges());
  EXPECT_NEAR(half_mm, 5.0, 0.8);  // and kNearOpening_mm before it
  shape.label.assign(shape.label.size(), static_cast<std::uint8_t>(assets::Tissue::other_teeth));
  EXPECT_TRUE(shape.edges().empty());
}

TEST(SharpEdges, OfNothingOpenedThereAreNone) {
  Shape shape(0.25, [](const glm::dvec3& p) { return ridge_mm(p, 90.0 * kDegree_rad); });
  shape.opened.assign(shape.opened.size(), 0);
  EXPECT_TRUE(shape.edges().empty());
}

}  // namespace
}  // namespace app
