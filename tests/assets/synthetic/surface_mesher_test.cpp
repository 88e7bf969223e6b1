#include "assets/synthetic/surface_mesher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <numbers>

#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

double ballAtOrigin(const glm::dvec3& p) { return glm::length(p) - 10.0; }

double volume_mm3(const MeshPart& part) {
  double volume = 0.0;
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(part.position_mm[part.triangles[t + i]]); };
    volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
  }
  return volume;
}

TEST(SurfaceMesher, PutsVerticesOnTheSurfaceWithOutwardNormals) {
  for (const double adaptivity : {0.0, 0.05}) {
    const MeshPart part = meshOf(ballAtOrigin, {glm::dvec3(-12), glm::dvec3(12)}, 1.0, adaptivity);
    ASSERT_GT(part.position_mm.size(), 100u);
    for (std::size_t n = 0; n < part.position_mm.size(); ++n) {
      const glm::dvec3 p(part.position_mm[n]);
      EXPECT_NEAR(glm::length(p), 10.0, 0.02);
      EXPECT_GT(glm::dot(glm::normalize(p), glm::dvec3(part.normal[n])), 0.9999);
    }
  }
}

TEST(SurfaceMesher, WindsTrianglesOutward) {
  const MeshPart part = meshOf(ballAtOrigin, {glm::dvec3(-12), glm::dvec3(12)}, 0.5, 0.0);
  EXPECT_NEAR(volume_mm3(part), 4.0 / 3.0 * std::numbers::pi * 1000.0, 15.0);
}

TEST(SurfaceMesher, ClosesTheSurface) {
  const MeshPart part = meshOf(
      [](const glm::dvec3& p) {
        return smoothMin(ballAtOrigin(p), ball(p, {14, 0, 0}, 6), 4.0);
      },
      {{-12, -12, -12}, {22, 12, 12}}, 1.0, 0.02);
  // Each edge is used once in each direction.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked;
  for (std::size_t t = 0; t < part.triangles.size(); t += 3) {
    for (std::size_t i = 0; i < 3; ++i) ++walked[{part.triangles[t + i], part.triangles[t + (i + 1) % 3]}];
  }
  for (const auto& [edge, times] : walked) {
    EXPECT_EQ(times, 1);
    EXPECT_TRUE(walked.contains({edge.second, edge.first}));
  }
}

TEST(SurfaceMesher, EvaluatesTheBandAroundTheSurfaceAndLittleElse) {
  constexpr double kVoxel_mm = 0.5;
  std::atomic<int> evaluations{0};
  const MeshPart part = meshOf([&](const glm::dvec3& p) { return ++evaluations, ballAtOrigin(p); },
                               {glm::dvec3(-12), glm::dvec3(12)}, kVoxel_mm, 0.0);
  // Three voxels on either side; four more a vertex put it onto the surface.
  const double in_band = 4.0 * std::numbers::pi * 100.0 * 6.0 / (kVoxel_mm * kVoxel_mm);
  const double a_voxel = (evaluations - 4.0 * static_cast<double>(part.position_mm.size())) / in_band;
  EXPECT_GT(a_voxel, 1.0);
  EXPECT_LT(a_voxel, 2.2);
}

}  // namespace
}  // namespace assets
