#include "app/procedure/drawn_plan/drawn_cut.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// A block of bone, of which a slot 2 mm wide along x is gone, from x = 0 on, from z = -3 up.
struct Slot {
  assets::VolumeGrid grid{glm::ivec3(80, 60, 40), 0.25, glm::dvec3(-10.0, -7.375, -9.75)};
  std::vector<std::uint8_t> before, after;

  Slot() : before(grid.voxelCount(), 255), after(before) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = grid.centre_P_mm(ijk);
      if (p.x > 0.0 && std::abs(p.y) < 1.0 && p.z > -3.0) after[v] = 0;
    });
  }
  double removed_mm3() const {
    double sum = 0.0;
    for (std::size_t v = 0; v < after.size(); ++v) sum += (before[v] - after[v]) / 255.0;
    return sum * grid.voxelVolume_mm3();
  }
  DrawnCut against(const std::vector<glm::dvec3>& line, const glm::dvec3& outward, double beside_mm = 3.0) const {
    return drawnCut(line, outward, beside_mm, grid, before, after);
  }
};

TEST(DrawnCut, FollowsALineAsFarAsSomethingWasRemovedUnderIt) {
  const Slot slot;
  const DrawnCut cut = slot.against({{-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, {0.0, 0.0, 2.0});
  EXPECT_NEAR(cut.length_mm, 16.0, 1e-9);
  // The slot and what is within the reach before its end.
  EXPECT_NEAR(cut.followed_share, (8.0 + kFollows_mm) / 16.0, 0.03);
  EXPECT_NEAR(cut.removed_mm3, slot.removed_mm3(), 1e-6);
  EXPECT_EQ(cut.beside_mm3, 0.0);
  // Evenly from the line to 1 mm beside it; beyond its end at 8 mm a little farther.
  EXPECT_NEAR(cut.off_mm, 0.5, 0.15);
}

TEST(DrawnCut, IsSeenAlongTheWayInSoThatDepthIsNoDistance) {
  const Slot slot;
  const DrawnCut above = slot.against({{0.0, 0.0, 25.0}, {8.0, 0.0, 25.0}}, {0.0, 0.0, 1.0});
  const DrawnCut on = slot.against({{0.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, {0.0, 0.0, 1.0});
  EXPECT_EQ(above.followed_share, on.followed_share);
  EXPECT_NEAR(above.off_mm, on.off_mm, 1e-9);
}

TEST(DrawnCut, TellsWhatLiesBesideTheLine) {
  const Slot slot;
  // Parallel, 2 mm to the side: half of the slot is farther than 2 mm.
  const DrawnCut cut = slot.against({{0.0, 2.0, 0.0}, {9.9, 2.0, 0.0}}, {0.0, 0.0, 1.0}, 2.0);
  EXPECT_NEAR(cut.beside_mm3 / cut.removed_mm3, 0.5, 0.05);
  EXPECT_NEAR(cut.off_mm, 2.0, 0.05);
  EXPECT_EQ(cut.followed_share, 0.0);
}

TEST(DrawnCut, OfNothingThatWasRemovedIsNothing) {
  Slot slot;
  slot.after = slot.before;
  const DrawnCut cut = slot.against({{0.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, {0.0, 0.0, 1.0});
  EXPECT_EQ(cut, (DrawnCut{.length_mm = 8.0}));
}

}  // namespace
}  // namespace app
