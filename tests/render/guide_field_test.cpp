// Distances to the guides, against geometry; and the tube around the canal.
#include "render/volume/guide_field.h"

#include <gtest/gtest.h>

#include "render/scene/guide_tube.h"
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

TEST(GuideField, MeasuresAPlannedCutAsABallSweptAlongItsStrokes) {
  assets::PlannedCut cut;
  cut.bur_radius_mm = 1.5;
  cut.strokes_P_mm = {{{1, -2, 3}, {1, 6, 3}}};
  const GuideField field = guideField(kGrid, {{}, 1.4, cut});
  for (const glm::ivec3 cell : {glm::ivec3(17, 18, 19), glm::ivec3(16, 22, 18), glm::ivec3(19, 14, 20)}) {
    const glm::dvec3 p = centreOf(cell);
    const double swept_mm = calibration::distanceToSegment(p, cut.strokes_P_mm[0][0], cut.strokes_P_mm[0][1]) - 1.5;
    EXPECT_NEAR(mmOf(field.at(cell)->y), std::min(swept_mm, 1.5), 0.15) << "sampled on a lattice of its own";
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

TEST(CanalTube, DashesCoverTheirShareOfTheLineAndLieOnTheTube) {
  // A bent line, so that dashes go on over its corners.
  std::vector<glm::dvec3> line;
  for (int n = 0; n <= 60; ++n) line.emplace_back(0.5 * n, 3.0 * std::sin(0.1 * n), 0.0);
  double length_mm = 0.0;
  for (std::size_t n = 0; n + 1 < line.size(); ++n) length_mm += glm::distance(line[n], line[n + 1]);
  const assets::MeshModel dashes = mandibularCanalDashes(line, 1.4), tube = mandibularCanalTube(line, 1.4);
  ASSERT_EQ(dashes.parts.size(), 1u);
  const assets::MeshPart& part = dashes.parts[0];
  double area = 0.0, whole = 0.0;
  const auto areaOf = [](const assets::MeshPart& mesh, double& sum) {
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
      const auto at = [&](std::size_t c) { return glm::dvec3(mesh.position_mm[mesh.triangles[t + c]]); };
      sum += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
  };
  areaOf(part, area);
  areaOf(tube.parts[0], whole);
  const double disc = M_PI * 1.4 * 1.4;
  EXPECT_NEAR(area / (whole - 2.0 * disc), kCanalDash_mm / (kCanalDash_mm + kCanalDashGap_mm), 0.05)
      << "of the wall, without ends";
  // Every corner of a dash lies on an edge of the tube's wall that runs along it.
  for (const glm::vec3& p : part.position_mm) {
    double away_mm = 1e9;
    const assets::MeshPart& wall = tube.parts[0];
    for (std::size_t t = 0; t + 2 < wall.triangles.size(); t += 3) {
      const auto at = [&](std::size_t c) { return glm::dvec3(wall.position_mm[wall.triangles[t + c]]); };
      away_mm = std::min(away_mm, calibration::distanceToSegment(glm::dvec3(p), at(0), at(2)));
    }
    EXPECT_LT(away_mm, 1e-4);
  }
  const glm::vec4 dim = part.material.base_colour, bright = tube.parts[0].material.base_colour;
  EXPECT_LT(dim.r, 0.7f * bright.r) << "behind bone it is dim";
  EXPECT_TRUE(mandibularCanalDashes({}, 1.4).parts.empty());
}

}  // namespace
}  // namespace render
