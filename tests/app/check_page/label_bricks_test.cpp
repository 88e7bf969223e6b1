#include "app/check_page/label_bricks.h"

#include <gtest/gtest.h>

#include <random>

#include "app/check_page/jaw_views.h"

namespace app {
namespace {

/// Slow and obvious.
int nearest(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what, const glm::ivec3& brick,
            bool of_tooth) {
  int least = 255;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (what[v] == 0 || (of_tooth && what[v] == kBoneVoxel)) return;
    const glm::ivec3 off = glm::abs(ijk / LabelBricks::kEdge - brick);
    least = std::min(least, std::max({off.x, off.y, off.z}));
  });
  return least;
}

void expectDistances(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what, const LabelBricks& bricks) {
  const glm::ivec3 size = (grid.size + LabelBricks::kEdge - 1) / LabelBricks::kEdge;
  assets::forVoxels(glm::ivec3(0), size, [&](glm::ivec3 brick) {
    ASSERT_EQ(bricks.distanceAt(brick, LabelBricks::bone_or_tooth), nearest(grid, what, brick, false));
    ASSERT_EQ(bricks.distanceAt(brick, LabelBricks::tooth_alone), nearest(grid, what, brick, true));
  });
}

TEST(LabelBricks, SayHowFarTheNearestBoneAndToothAre) {
  std::mt19937 random(7);
  const auto below = [&random](int end) { return std::uniform_int_distribution<int>(0, end - 1)(random); };
  for (int trial = 0; trial < 20; ++trial) {
    const assets::VolumeGrid grid{{3 + below(30), 3 + below(30), 3 + below(40)}, 0.4, glm::dvec3(0.0)};
    std::vector<std::uint8_t> what(grid.voxelCount(), 0);
    const auto any = [&] { return glm::ivec3(below(grid.size.x), below(grid.size.y), below(grid.size.z)); };
    // Nothing at all, bone alone, a few of both.
    for (int n = below(4); n > 0; --n) what[grid.index(any())] = kBoneVoxel;
    if (trial % 3 != 0) what[grid.index(any())] = 48;
    LabelBricks bricks;
    bricks.find(grid, what);
    expectDistances(grid, what, bricks);
    // Voxels that are painted, one after the other.
    for (int n = 0; n < 6; ++n) {
      const glm::ivec3 at = any();
      const std::uint8_t now = n % 2 == 0 ? 36 : kBoneVoxel;
      if (what[grid.index(at)] != 0) continue;
      what[grid.index(at)] = now;
      bricks.add(at, now);
      expectDistances(grid, what, bricks);
    }
  }
}

}  // namespace
}  // namespace app
