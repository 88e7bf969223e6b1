// Bone in the way of a piece, taken away without tooth, neighbour and canal.

#include "app/procedure/third_molar/clearing_plan.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "haptics/device/simulated/trough_path.h"
#include "tests/app/procedure/third_molar_phantom.h"

namespace app {
namespace {

TEST(ClearingPlan, TakesAwayALidAndSparesToothNeighbourAndCanal) {
  assets::Patient patient = phantom(8.0);
  std::vector<glm::dvec3> lid;
  assets::forVoxels(patient.ct.grid, [&](glm::ivec3 ijk, std::size_t) {
    const glm::dvec3 p = patient.ct.grid.centre_P_mm(ijk);
    if (std::abs(p.x) < 2.5 && std::abs(p.y) < 3.0 && p.z > 6.0 && p.z < 8.0) lid.push_back(p);
  });
  const auto cut = planClearing(SiteSolid(patient), lid, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour), tooth = solidOf(patient.ct, kFdi);
  sweep(patient.ct, *cut);
  const auto left = std::ranges::count_if(lid, [&](const glm::dvec3& p) {
    return patient.ct.solid[patient.ct.grid.index(glm::ivec3(glm::round(patient.ct.grid.indexFromPoint(p))))] != 0;
  });
  EXPECT_LT(static_cast<double>(left), 0.3 * static_cast<double>(lid.size()));
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
  EXPECT_EQ(solidOf(patient.ct, kFdi), tooth);
}

TEST(ClearingPlan, SparesTheNeighbourAndGoesOverItFromStrokeToStroke) {
  assets::Patient patient = phantom(3.0);
  // Bone to the cheek and to the tongue of it.
  std::vector<glm::dvec3> beside;
  for (double side : {-1.0, 1.0})
    for (double x = 4.2; x < 6.5; x += 0.4)
      for (double y = -10.0; y < -6.0; y += 0.4)
        for (double z : {1.0, 1.5, 2.0, 2.5}) beside.push_back({side * x, y, z});
  const auto cut = planClearing(SiteSolid(patient), beside, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  double top_mm = -1e9, least_x_mm = 1e9, most_x_mm = -1e9;
  for (const auto& stroke : cut->strokes_P_mm)
    for (const glm::dvec3& p : stroke) {
      top_mm = std::max(top_mm, glm::dot(p, cut->outward_P));
      least_x_mm = std::min(least_x_mm, p.x);
      most_x_mm = std::max(most_x_mm, p.x);
    }
  EXPECT_LT(least_x_mm, -5.0);
  EXPECT_GT(most_x_mm, 5.0);
  const double neighbour_mm = glm::dot(glm::dvec3(0.0, -9.0, 7.0), cut->outward_P);
  EXPECT_GT(top_mm + cut->over_mm, neighbour_mm + kBur_mm);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour);
  sweep(patient.ct, *cut);
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
}

TEST(ClearingPlan, KeepsOffTheCanal) {
  const assets::Patient patient = phantom(3.0);
  std::vector<glm::dvec3> deep;
  for (double x = 5.2; x < 6.8; x += 0.4)
    for (double y = -1.0; y < 1.1; y += 0.4)
      for (double z = -10.5; z < -5.0; z += 0.4) deep.push_back({x, y, z});
  const auto cut = planClearing(SiteSolid(patient), deep, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  EXPECT_GT(nearestCanal_mm(patient, *cut), 1.4);
}

TEST(ClearingPlan, LeavesTheWallTowardsTheTongue) {
  const assets::Patient patient = phantom(3.0);
  // The jaw ends at x = 6.4; bone up to there is in the way.
  constexpr double kEnd_mm = 6.4;
  std::vector<glm::dvec3> surface, beside;
  for (double y = -16.0; y < 12.0; y += 0.4)
    for (double z = -14.0; z < 3.0; z += 0.4) surface.push_back({kEnd_mm, y, z});
  for (double x = 4.0; x < kEnd_mm; x += 0.4)
    for (double y = -3.0; y < 3.1; y += 0.4)
      for (double z : {-1.0, 0.0, 1.0, 2.0}) beside.push_back({x, y, z});
  const auto nearest_mm = [&](std::span<const glm::dvec3> tongue_P_mm) {
    const auto cut = planClearing(SiteSolid(patient, tongue_P_mm), beside, kBur_mm, 0.1, {.tongue_mm = 0.45});
    double least_mm = 1e9;
    for (const auto& stroke : cut.value().strokes_P_mm)
      for (const glm::dvec3& p : stroke)
        for (const glm::dvec3& q : surface) least_mm = std::min(least_mm, glm::distance(p, q));
    return least_mm - kBur_mm;
  };
  EXPECT_LT(nearest_mm({}), 0.0);
  EXPECT_GT(nearest_mm(surface), 0.3);
}

TEST(ClearingPlan, GoesFromStrokeToStrokeNoHigherThanItHasTo) {
  assets::Patient patient = phantom(3.0);
  // Low bone to the cheek, the neighbour between its two ends.
  std::vector<glm::dvec3> low;
  for (double x = -6.0; x < 6.1; x += 0.4)
    for (double y = -9.0; y < -4.0; y += 0.4)
      for (double z : {1.0, 2.0})
        if (std::abs(x) > 4.4) low.push_back({x, y, z});
  auto cut = planClearing(SiteSolid(patient), low, kBur_mm, 0.1);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->hop_mm.size(), cut->strokes_P_mm.size());
  cut->shaft_P = cut->outward_P;
  const auto path_of = [&](const assets::PlannedCut& plan) {
    return haptics::TroughPath(plan, {.shaft_P = plan.shaft_P});
  };
  const haptics::TroughPath path = path_of(*cut);
  assets::PlannedCut way = *cut, high = *cut;
  high.hop_mm.clear();
  EXPECT_LT(path.duration_s(), 0.98 * path_of(high).duration_s());
  // Wherever it goes it meets no neighbour.
  way.strokes_P_mm = {{}};
  for (double t_s = 0.0; t_s < path.duration_s(); t_s += 0.005)
    way.strokes_P_mm.front().push_back(path.at(t_s).position_mm);
  const std::size_t neighbour = solidOf(patient.ct, kNeighbour);
  sweep(patient.ct, way);
  EXPECT_EQ(solidOf(patient.ct, kNeighbour), neighbour);
}

TEST(ClearingPlan, LeavesWhatNoBurReaches) {
  const assets::Patient patient = phantom(3.0);
  // Under the neighbour.
  const std::vector<glm::dvec3> hidden(40, glm::dvec3(0.0, -9.0, -11.0));
  EXPECT_FALSE(planClearing(SiteSolid(patient), hidden, kBur_mm, 0.1));
}

}  // namespace
}  // namespace app
