#include "app/session/measures/plan_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace app {
namespace {

/// A block of bone, of which a box of voxels is taken.
struct Block {
  assets::VolumeGrid grid{{30, 30, 30}, 0.5, glm::dvec3(0.0)};
  std::vector<std::uint8_t> before = std::vector<std::uint8_t>(grid.voxelCount(), 255);

  std::vector<std::uint8_t> without(glm::ivec3 low, glm::ivec3 end) const {
    std::vector<std::uint8_t> after = before;
    assets::forVoxels(low, end, [&](glm::ivec3 ijk) { after[grid.index(ijk)] = 0; });
    return after;
  }
  PlanComparison against(const std::vector<std::uint8_t>& after, glm::dvec3 low_mm, glm::dvec3 high_mm) const {
    const auto everything = [](std::size_t) { return true; };
    return compareWithPlan(grid, before, after, everything, [=](const glm::dvec3& p) {
      const glm::dvec3 q = glm::max(low_mm - p, p - high_mm);
      return std::max({q.x, q.y, q.z});
    });
  }
};

TEST(PlanComparison, ACubeShiftedByAVoxelHasDiceNineTenths) {
  const Block block;
  const PlanComparison found =
      block.against(block.without({6, 5, 5}, {16, 15, 15}), glm::dvec3(4 * 0.5 + 0.25), glm::dvec3(14 * 0.5 + 0.25));
  EXPECT_NEAR(found.planned_mm3, 125.0, 1e-9);
  EXPECT_NEAR(found.removed_mm3, 125.0, 1e-9);
  EXPECT_NEAR(*found.dice(), 0.9, 1e-9);
  EXPECT_NEAR(found.over_mm3(), 12.5, 1e-9);
  EXPECT_NEAR(found.under_mm3(), 12.5, 1e-9);
}

TEST(PlanComparison, ASlabOfAMillimetreBeyondThePlanIsAMillimetreDeep) {
  const Block block;
  const PlanComparison found =
      block.against(block.without({5, 5, 5}, {15, 15, 17}), glm::dvec3(2.25), glm::dvec3(7.25));
  EXPECT_NEAR(found.over_mm3(), 25.0, 1e-9);
  EXPECT_NEAR(*found.over_max_mm, 1.0, 0.5) << "within a voxel";
  EXPECT_NEAR(*found.over_mean_mm, 0.75, 0.25);
  EXPECT_LE(*found.over_p95_mm, *found.over_max_mm);
  EXPECT_NEAR(found.under_mm3(), 0.0, 1e-9);
}

TEST(PlanComparison, NothingCutOrPlannedIsNotCompared) {
  const Block block;
  const PlanComparison found = block.against(block.before, glm::dvec3(-3.0), glm::dvec3(-2.0));
  EXPECT_FALSE(found.dice());
  EXPECT_FALSE(found.over_max_mm);
  EXPECT_EQ(found.over_mm3(), 0.0);
}

TEST(PlanComparison, OnlyWhatCountsIsCounted) {
  const Block block;
  const std::vector<std::uint8_t> after = block.without({5, 5, 5}, {15, 15, 15});
  const auto none = [](std::size_t) { return false; };
  EXPECT_EQ(compareWithPlan(block.grid, block.before, after, none, [](const glm::dvec3&) { return -1.0; }).planned_mm3,
            0.0);
  EXPECT_EQ(compareRemovals(block.grid, block.before, after, after, none).a_mm3, 0.0);
}

TEST(PlanComparison, TwoRemovalsAreToldApart) {
  const Block block;
  const RemovalDifference found =
      compareRemovals(block.grid, block.before, block.without({5, 5, 5}, {15, 15, 15}),
                      block.without({6, 5, 5}, {16, 15, 15}), [](std::size_t) { return true; });
  EXPECT_NEAR(found.both_mm3, 112.5, 1e-9);
  EXPECT_NEAR(found.onlyInA_mm3(), 12.5, 1e-9);
  EXPECT_NEAR(found.onlyInB_mm3(), 12.5, 1e-9);
  EXPECT_NEAR(*found.dice(), 0.9, 1e-9);
}

}  // namespace
}  // namespace app
