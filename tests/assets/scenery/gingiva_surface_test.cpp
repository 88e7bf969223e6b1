#include "assets/scenery/gingiva_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/load_error.h"
#include "assets/scenery/reflected_flap.h"
#include "assets/surface_smoothing.h"

namespace assets {
namespace {

// A ridge of bone under 2 mm of gingiva, 40 mm long; a left third molar in its middle.
constexpr double kGingivaTop_mm = 2.0;

CtVolume ridge() {
  CtVolume ct;
  ct.grid = {{120, 160, 48}, 0.3, {2.0, -24.0, -10.0}};
  ct.label.assign(ct.grid.voxelCount(), 0);
  for (int k = 4; k < ct.grid.size.z; ++k) {
    for (int j = 4; j < ct.grid.size.y - 4; ++j) {
      for (int i = 4; i < ct.grid.size.x - 4; ++i) {
        const double z = ct.grid.centre_P_mm({i, j, k}).z;
        const Tissue tissue = z < 0.0 ? Tissue::cortical : z < kGingivaTop_mm ? Tissue::gingiva : Tissue::unlabelled;
        ct.label[ct.grid.index({i, j, k})] = static_cast<std::uint8_t>(tissue);
      }
    }
  }
  return ct;
}

/// A stroke along the crest, seen from the front and above.
PlannedCut cutAlongTheCrest() {
  PlannedCut cut;
  cut.strokes_P_mm = {{{20.0, -5.0, 0.0}, {20.0, 5.0, 0.0}}};
  cut.outward_P = {0.0, 0.0, 1.0};
  cut.lateral_P = {1.0, 0.0, 0.0};
  cut.sight_P = {0.0, -0.6, 0.8};
  cut.bur_radius_mm = 1.5;
  return cut;
}

TEST(GingivaSurface, LiesOnTheTopOfTheLabelledGingiva) {
  const MeshModel model = gingivaSurface(ridge(), std::nullopt);
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].name, "Gum");
  int tops = 0;
  for (std::size_t n = 0; n < model.parts[0].position_mm.size(); ++n) {
    const glm::vec3& p = model.parts[0].position_mm[n];
    if (model.parts[0].normal[n].z < 0.9f || p.x < 6 || p.x > 34 || std::abs(p.y) > 20) continue;
    EXPECT_NEAR(p.z, kGingivaTop_mm, 0.3);
    ++tops;
  }
  EXPECT_GT(tops, 1000);
}

TEST(GingivaSurface, KeepsItsUndersideInsideTheBone) {
  const MeshModel model = gingivaSurface(ridge(), std::nullopt);
  for (std::size_t n = 0; n < model.parts[0].position_mm.size(); ++n) {
    const glm::vec3& p = model.parts[0].position_mm[n];
    if (model.parts[0].normal[n].z > -0.9f || p.x < 6 || p.x > 34) continue;
    EXPECT_LT(p.z, -0.2);
  }
}

TEST(GingivaSurface, BaresTheCutAndTwoMillimetresAroundItAndKeepsTheRest) {
  const MeshModel model = gingivaSurface(ridge(), cutAlongTheCrest());
  double nearest_mm = 1e9;
  int beside = 0;
  for (const glm::vec3& v : model.parts.at(0).position_mm) {
    const glm::dvec3 p(v);
    if (p.z > 0.5) nearest_mm = std::min(nearest_mm, std::hypot(p.x - 20.0, std::max(std::abs(p.y) - 5.0, 0.0)));
    beside += p.z > 1.0 && p.x > 26.0 && p.x < 32.0 && std::abs(p.y) < 8.0 ? 1 : 0;
  }
  EXPECT_GT(nearest_mm, 1.5 + kFlapMargin_mm - 1.2) << "rounded edge";
  EXPECT_LT(nearest_mm, 1.5 + kFlapMargin_mm + 1.0);
  EXPECT_GT(beside, 300);
}

TEST(Wound, ReachesFromTheCutTowardsTheEye) {
  const PlannedCut cut = cutAlongTheCrest();
  const Wound wound(cut);
  EXPECT_NEAR(wound.distance_mm({20.0, 0.0, 0.0}), -1.5 - kFlapMargin_mm, 0.3);
  EXPECT_NEAR(wound.distance_mm({24.5, 0.0, 0.0}), 1.0, 0.2);
  EXPECT_LT(wound.distance_mm(glm::dvec3(20.0, -5.0, 0.0) + 8.0 * cut.sight_P), -1.0) << "in the line of sight";
  EXPECT_GT(wound.distance_mm({20.0, 13.0, 6.4}), 0.0) << "the other way";
}

/// Where a papilla stands higher than what is between the cut and the eye.
TEST(Wound, ReachesUpFromThereInFrontAndNotBehind) {
  PlannedCut cut = cutAlongTheCrest();
  const Wound wound(cut);
  EXPECT_LT(wound.distance_mm({20.0, -8.0, 17.0}), -1.0) << "above the way to the eye";
  EXPECT_GT(wound.distance_mm({20.0, -8.0, -5.0}), 1.0) << "below";
  EXPECT_GT(wound.distance_mm({20.0, 6.0, 6.0}), 0.5) << "at the ramus";
  cut.outward_P.z = -1.0;
  cut.sight_P.z = -0.8;
  EXPECT_LT(Wound(cut).distance_mm({20.0, -8.0, -17.0}), -1.0) << "in the upper jaw";
}

TEST(GingivaSurface, IsDarkerAtTheWoundsEdge) {
  const Wound wound(cutAlongTheCrest());
  const MeshModel model = gingivaSurface(ridge(), cutAlongTheCrest());
  double edge = 0.0, far = 0.0;
  int edges = 0, fars = 0;
  for (std::size_t n = 0; n < model.parts[0].position_mm.size(); ++n) {
    const double d = wound.distance_mm(glm::dvec3(model.parts[0].position_mm[n]));
    if (d < 0.5) edge += model.parts[0].colour[n].r, ++edges;
    if (d > 3.5) far += model.parts[0].colour[n].r, ++fars;
  }
  ASSERT_GT(edges, 50);
  ASSERT_GT(fars, 50);
  EXPECT_LT(edge / edges, 0.75 * far / fars);
}

TEST(GingivaSurface, LaysAThickFlapOverTheCheeksSideAndKeepsItOutOfTheWound) {
  const Wound wound(cutAlongTheCrest());
  const MeshModel model = gingivaSurface(ridge(), cutAlongTheCrest());
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.parts[0].name, "Gum");
  EXPECT_EQ(model.parts[1].name, "Gum flap");
  double highest_mm = 0.0, highest_of_tongue_side_mm = 0.0, highest_beside_flap_mm = 0.0;
  for (const MeshPart& part : model.parts)
    for (const glm::vec3& v : part.position_mm) {
      const glm::dvec3 p(v);
      if (p.z < kGingivaTop_mm - 0.5) continue;
      double& highest = p.x > 20.0 ? highest_mm : highest_of_tongue_side_mm;
      highest = std::max(highest, p.z);
      EXPECT_GT(wound.distance_mm(p), -0.6) << "between the cut and the eye: " << p.x << ' ' << p.y << ' ' << p.z;
      if (&part == &model.parts[0])
        highest_beside_flap_mm = std::max(highest_beside_flap_mm, p.z);
      else
        EXPECT_GT(p.x, 20.0) << "the flap lies on the cheek's side";
    }
  EXPECT_LT(highest_beside_flap_mm, kGingivaTop_mm + 0.7 * kFlapThickness_mm);
  EXPECT_NEAR(highest_mm, kGingivaTop_mm + kFlapThickness_mm + ReflectedFlap::kLift_mm, 0.5)
      << "its free edge is lifted";
  EXPECT_NEAR(highest_of_tongue_side_mm, kGingivaTop_mm, 0.3);
}

TEST(GingivaSurface, IsWetterOnTheFlap) {
  const MeshModel model = gingivaSurface(ridge(), cutAlongTheCrest());
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_LT(model.parts[1].material.roughness, 0.7f * model.parts[0].material.roughness);
}

// A ball of triangles of about 0.3 mm with ripples of its radius.
TEST(TakeOffLumps, RemovesShortWavesAndKeepsTheShape) {
  constexpr int kRings = 100;
  constexpr float kRadius_mm = 10.0f, kLump_mm = 0.1f;
  std::vector<glm::vec3> at;
  std::vector<std::uint32_t> triangles;
  for (int j = 1; j < kRings; ++j)
    for (int i = 0; i < 2 * kRings; ++i) {
      const float theta = 3.14159265f * static_cast<float>(j) / kRings,
                  phi = 3.14159265f * static_cast<float>(i) / kRings;
      const float r = kRadius_mm + kLump_mm * std::sin(40.0f * theta) * std::sin(40.0f * phi);
      at.emplace_back(r * glm::vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
    }
  const auto row = static_cast<std::uint32_t>(2 * kRings);
  for (std::uint32_t j = 0; j + 2 < static_cast<std::uint32_t>(kRings); ++j)
    for (std::uint32_t i = 0; i < row; ++i) {
      const std::uint32_t a = j * row + i, b = j * row + (i + 1) % row;
      triangles.insert(triangles.end(), {a, a + row, b + row, a, b + row, b});
    }
  const auto figures = [&] {
    double mean = 0.0, square = 0.0;
    int count = 0;
    for (const glm::vec3& p : at) {
      if (std::abs(p.z) > 5.0f) continue;
      const double r = static_cast<double>(glm::length(p));
      mean += r, square += r * r, ++count;
    }
    mean /= count;
    return std::pair(mean, std::sqrt(square / count - mean * mean));
  };
  const auto [radius_before, lumps_before] = figures();
  takeOffLumps(at, triangles, 40);
  const auto [radius_after, lumps_after] = figures();
  EXPECT_LT(lumps_after, 0.3 * lumps_before);
  EXPECT_NEAR(radius_after, radius_before, 0.02);
}

TEST(GingivaSurface, LeavesOutWhatFloatsInTheAirAndKeepsASecondJaw) {
  CtVolume ct = ridge();
  const auto label = [&](glm::ivec3 low, glm::ivec3 size) {
    forVoxels(low, low + size,
              [&](glm::ivec3 at) { ct.label[ct.grid.index(at)] = static_cast<std::uint8_t>(Tissue::gingiva); });
  };
  const auto highest_mm = [&] {
    double z_mm = -1e9;
    for (const MeshPart& part : gingivaSurface(ct, std::nullopt).parts)
      for (const glm::vec3& p : part.position_mm) z_mm = std::max(z_mm, double{p.z});
    return z_mm;
  };
  label({50, 70, 44}, {4, 4, 2});  // 1.2 mm wide, above the ridge
  EXPECT_LT(highest_mm(), kGingivaTop_mm + 0.5);
  label({20, 20, 44}, {60, 60, 2});  // 18 mm wide
  EXPECT_GT(highest_mm(), kGingivaTop_mm + 0.5);
}

TEST(GingivaSurface, IsEmptyWithoutGingiva) {
  CtVolume ct = ridge();
  for (std::uint8_t& label : ct.label) label = label == 9 ? 0 : label;
  EXPECT_TRUE(gingivaSurface(ct, cutAlongTheCrest()).parts.empty());
}

TEST(GingivaSurface, RefusesLabelsOfAnotherGrid) {
  CtVolume ct = ridge();
  ct.label.pop_back();
  EXPECT_THROW(gingivaSurface(ct, {}), LoadError);
}

}  // namespace
}  // namespace assets
