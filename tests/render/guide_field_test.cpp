// Distances to the guides, against geometry; and the tube around the canal.
#include "render/volume/guide_field.h"

#include <gtest/gtest.h>

#include "render/scene/mandibular_canal_tube.h"
#include "render/shaders/shared_constants.glsl"

namespace render {
namespace {

const assets::VolumeGrid kGrid{glm::ivec3(64), 0.5, glm::dvec3(-15.75)};

double mmOf(std::uint16_t value) { return GUIDE_LOW_MM + value / 65535.0 * (GUIDE_HIGH_MM - GUIDE_LOW_MM); }

glm::dvec3 centreOf(glm::ivec3 cell) {
  return kGrid.origin_P_mm +
         kGrid.spacing_mm * (0.5 * (AMBIENT_CELL_VOXELS - 1) + double{AMBIENT_CELL_VOXELS} * glm::dvec3(cell));
}

TEST(GuideField, HoldsTheDistanceToTheWallOfAStraightCanal) {
  const GuideField field = guideField(kGrid, {{{-20, 1, 2}, {-3, 1, 2}, {20, 1, 2}}, 1.4, {}});
  int compared = 0;
  for (int n = 0; n < 32 * 32 * 32; ++n) {
    const glm::ivec3 cell{n % 32, n / 32 % 32, n / 1024};
    const glm::dvec3 p = centreOf(cell);
    const double wall_mm = glm::length(glm::dvec2(p.y - 1.0, p.z - 2.0)) - 1.4;
    const double held_mm = mmOf(field.at(cell)->x);
    if (wall_mm > 4.0) {
      EXPECT_GT(held_mm, 4.0);
      continue;
    }
    EXPECT_NEAR(held_mm, wall_mm, 2e-4);
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(GuideField, MeasuresAPlannedCutAsABallSweptOverARectangle) {
  const PlannedCut cut{{1, 2, 3}, {0, 1, 0}, {0, 0, 1}, 4.0, 2.0, 1.5};
  EXPECT_NEAR(distanceToCut_mm(cut, {1, 2, 3}), -1.5, 1e-12);
  EXPECT_NEAR(distanceToCut_mm(cut, {3, 2, 3}), 0.5, 1e-12);
  EXPECT_NEAR(distanceToCut_mm(cut, {1, 9, 3}), 1.5, 1e-12);
  EXPECT_NEAR(distanceToCut_mm(cut, {1, 9, 9}), 5.0 - 1.5, 1e-12);
  const GuideField field = guideField(kGrid, {{}, 1.4, cut});
  for (const glm::ivec3 cell : {glm::ivec3(17, 18, 19), glm::ivec3(16, 22, 18), glm::ivec3(19, 14, 20)}) {
    EXPECT_NEAR(mmOf(field.at(cell)->y), distanceToCut_mm(cut, centreOf(cell)), 2e-4);
    EXPECT_EQ(field.at(cell)->x, 65535) << "no canal";
  }
}

TEST(CanalTube, LiesAtTheRadiusWithNormalsOutward) {
  const std::vector<glm::dvec3> line{{0, 0, 0}, {0, 0, 0}, {5, 0, 0}, {10, 0, 0}};
  const assets::MeshModel tube = mandibularCanalTube(line, 1.4);
  ASSERT_EQ(tube.parts.size(), 1u);
  const assets::MeshPart& part = tube.parts[0];
  int on_wall = 0;
  for (std::size_t v = 0; v < part.position_mm.size(); ++v) {
    const glm::dvec3 p = part.position_mm[v], n = part.normal[v];
    const double radius = glm::length(glm::dvec2(p.y, p.z));
    if (radius < 1.0) continue;
    EXPECT_NEAR(radius, 1.4, 1e-5);
    EXPECT_NEAR(glm::dot(n, glm::dvec3(0, p.y, p.z) / radius), 1.0, 1e-5);
    ++on_wall;
  }
  EXPECT_EQ(on_wall, 3 * 24);
  for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
    const auto at = [&](std::size_t c) { return glm::dvec3(part.position_mm[part.triangles[t + c]]); };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    const glm::dvec3 out = (at(0) + at(1) + at(2)) / 3.0 - glm::dvec3(5, 0, 0);
    EXPECT_TRUE(glm::length(normal) < 1e-9 || glm::dot(normal, out) > 0.0);
  }
  EXPECT_TRUE(mandibularCanalTube({}, 1.4).parts.empty());
}

}  // namespace
}  // namespace render
