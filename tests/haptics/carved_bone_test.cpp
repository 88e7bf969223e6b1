#include "haptics/bone/carved_bone.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <random>
#include <thread>

#include "calibration/geometry/units.h"
#include "haptics/bone/carve.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/time_erosion.h"

namespace haptics {
namespace {

using namespace phantom;

/// Cuts one voxel alone; the solid steps it loses.
int cutVoxel(CarvedBone& bone, std::size_t voxel, double coverage, double loss, std::uint64_t tick) {
  const auto n = static_cast<int>(voxel);
  const glm::ivec3 size = bone.grid().size, ijk(n % size.x, n / size.x % size.y, n / (size.x * size.y));
  BlockCut cut;
  cut.tick = tick;
  const std::size_t within = SolidField::within(ijk);
  cut.coverage[within] = static_cast<std::uint16_t>(coverage * 65535.0 + 0.5);
  cut.exposure[within] = 65535;
  cut.loss_q32.fill(static_cast<std::uint32_t>(loss * 4294967295.0));
  std::array<std::int64_t, assets::kTissueCount> steps{};
  bone.cutBlock(ijk / kBlockEdge, cut, steps);
  return static_cast<int>(std::accumulate(steps.begin(), steps.end(), std::int64_t{0}));
}

TEST(CarvedBone, NeverGivesMoreThanItHeldNorGrows) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Phantom phantom = block(1.0, 0.25);
  for (auto& solid : phantom.solid) solid = static_cast<std::uint8_t>(random() % 256);
  CarvedBone bone = phantom.bone();
  for (std::size_t voxel = 0; voxel < phantom.solid.size(); ++voxel) {
    int given = 0;
    for (std::uint64_t tick = 0; tick < 40; ++tick) {
      const int step = cutVoxel(bone, voxel, part(random), 0.2 * part(random), tick);
      EXPECT_GE(step, 0);
      given += step;
    }
    EXPECT_LE(given, phantom.solid[voxel]);
    EXPECT_EQ(bone.solidInGridOrder()[voxel], phantom.solid[voxel] - given);
  }
}

TEST(CarvedBone, LosesNoMoreThanWasCovered) {
  CarvedBone bone = block(1.0, 0.25).bone();
  double left = 0.0;
  for (std::size_t voxel = 0; voxel < 512; ++voxel) {
    for (std::uint64_t tick = 0; tick < 100; ++tick) cutVoxel(bone, voxel, 0.3, 0.3, tick);
  }
  for (const std::uint8_t solid : bone.solidInGridOrder()) left += solid / 255.0 / 512.0;
  EXPECT_NEAR(left, 0.7, 0.002);
}

TEST(CarvedBone, CutsOnByTheNearestVoxelWhenItCanRememberNoMore) {
  // 2.1 million voxels of bone, three quarters of them cut: more than there is room to remember.
  CarvedBone bone = block(6.4, 0.1).bone();
  const std::size_t room = bone.blocksLeft();
  EXPECT_LT(room, 32768u);
  ErosionStep step;
  step.loss.fill(1.0);
  double removed = 0.0;
  for (double z : {-3.2, 3.2})
    for (double y : {-3.2, 3.2})
      for (double x : {-3.2, 3.2}) removed += carveSphere(bone, {{x, y, z}}, 3.0, step, 0).removed_mm3;
  EXPECT_EQ(bone.blocksLeft(), 0u);
  const double balls = 8.0 * 4.0 / 3.0 * calibration::kPi * 27.0;
  EXPECT_NEAR(removed, balls, 0.002 * balls);
  EXPECT_NEAR(bone.removedByTissue_mm3()[0], removed, 1e-9 * removed);
  // A bur that stays takes no more.
  double more = 0.0;
  for (std::uint64_t tick = 1; tick < 50; ++tick)
    more += carveSphere(bone, {{3.2, 3.2, 3.2}}, 3.0, step, tick).removed_mm3;
  EXPECT_LT(more, 1e-3 * balls);
}

TEST(CarvedBone, HoldsFourBytesAVoxelAtMost) {
  const Phantom phantom = block(12.8, 0.1);
  const CarvedBone bone = phantom.bone(1);
  EXPECT_LE(static_cast<double>(bone.bytes()) / static_cast<double>(phantom.grid.voxelCount()), 4.0);
}

TEST(CarvedBone, DigestTellsWhatWasCutAndNotInWhichOrder) {
  CarvedBone one = block(1.0, 0.25).bone(), other = block(1.0, 0.25).bone();
  EXPECT_EQ(one.digest(), other.digest());
  for (std::size_t voxel = 0; voxel < 100; ++voxel) cutVoxel(one, voxel, 1.0, 0.4, 7);
  EXPECT_NE(one.digest(), other.digest());
  for (std::size_t voxel = 100; voxel-- > 0;) cutVoxel(other, voxel, 1.0, 0.4, 7);
  EXPECT_EQ(one.digest(), other.digest());
  cutVoxel(one, 5, 1.0, 0.01, 8);
  EXPECT_NE(one.digest(), other.digest());
}

TEST(CarvedBone, SaysWhatOfEachTissueIsGone) {
  Phantom phantom = block(1.0, 0.25);
  phantom.solid[3] = 100;
  std::vector<std::uint8_t> label(phantom.solid.size(), 2);
  label[3] = 4;
  label[4] = 200;  // no tissue
  CarvedBone bone(phantom.grid, phantom.solid, label);
  const double voxel_mm3 = phantom.grid.voxelVolume_mm3();
  for (const std::size_t voxel : {3u, 4u, 5u, 6u}) cutVoxel(bone, voxel, 1.0, 1.0, 0);
  const auto removed_mm3 = bone.removedByTissue_mm3();
  EXPECT_NEAR(removed_mm3[4], 100.0 / 255.0 * voxel_mm3, 1e-12);
  EXPECT_NEAR(removed_mm3[0], voxel_mm3, 1e-12);
  EXPECT_NEAR(removed_mm3[2], 2.0 * voxel_mm3, 1e-12);
  EXPECT_EQ(removed_mm3[1], 0.0);
}

TEST(CarvedBone, CopiesABrickWithAirBeyondTheEdge) {
  Phantom phantom = block(1.25, 0.25);  // 10 voxels an edge: the second brick is mostly outside
  for (std::size_t i = 0; i < phantom.solid.size(); ++i) phantom.solid[i] = static_cast<std::uint8_t>(1 + i % 255);
  const CarvedBone bone = phantom.bone();
  std::array<std::uint8_t, 512> brick{};
  bone.copyBrick({1, 0, 1}, brick);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        const glm::ivec3 ijk(8 + i, j, 8 + k);
        const std::uint8_t expected = bone.grid().contains(ijk) ? phantom.solid[bone.grid().index(ijk)] : 0;
        EXPECT_EQ(brick[static_cast<std::size_t>((k * 8 + j) * 8 + i)], expected);
      }
}

TEST(DirtyBricks, NamesEveryBrickOnce) {
  DirtyBricks dirty({5, 4, 7});
  dirty.mark({4, 3, 6});
  dirty.mark({0, 0, 0});
  dirty.mark({4, 3, 6});
  std::vector<glm::ivec3> taken;
  dirty.takeInto(taken);
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0], glm::ivec3(0, 0, 0));
  EXPECT_EQ(taken[1], glm::ivec3(4, 3, 6));
  taken.clear();
  dirty.takeInto(taken);
  EXPECT_TRUE(taken.empty());
}

TEST(DirtyBricks, NameEveryBrickThatCarvingChanged) {
  CarvedBone bone = block(3.0, 0.1).bone();
  const std::vector<std::uint8_t> before = bone.solidInGridOrder();
  carveSphere(bone, {{0.21, -0.4, 0.3}}, 1.7, timeErosion({}, 0.05), 0);
  const std::vector<std::uint8_t> after = bone.solidInGridOrder();
  std::vector<glm::ivec3> taken;
  bone.dirtyBricks().takeInto(taken);
  const glm::ivec3 bricks = bone.grid().bricks();
  std::vector<bool> dirty(static_cast<std::size_t>(bricks.x * bricks.y * bricks.z));
  const auto at = [&](glm::ivec3 b) { return static_cast<std::size_t>((b.z * bricks.y + b.y) * bricks.x + b.x); };
  for (glm::ivec3 brick : taken) dirty[at(brick)] = true;
  for (int k = 0; k < bone.grid().size.z; ++k)
    for (int j = 0; j < bone.grid().size.y; ++j)
      for (int i = 0; i < bone.grid().size.x; ++i) {
        const std::size_t voxel = bone.grid().index({i, j, k});
        EXPECT_TRUE(after[voxel] == before[voxel] || dirty[at(glm::ivec3(i, j, k) / 8)]);
      }
}

TEST(CarvedBone, HandsItsBricksToAReaderWhileItIsCarved) {
  CarvedBone bone = block(3.0, 0.2).bone();
  std::vector<std::uint8_t> seen = bone.solidInGridOrder();
  std::atomic<bool> done{false};
  const auto take = [&] {
    std::vector<glm::ivec3> bricks;
    bone.dirtyBricks().takeInto(bricks);
    for (glm::ivec3 brick : bricks) {
      std::array<std::uint8_t, 512> copy{};
      bone.copyBrick(brick, copy);
      for (int n = 0; n < 512; ++n) {
        const glm::ivec3 ijk = brick * 8 + glm::ivec3(n % 8, n / 8 % 8, n / 64);
        if (bone.grid().contains(ijk)) seen[bone.grid().index(ijk)] = copy[static_cast<std::size_t>(n)];
      }
    }
  };
  std::thread reader([&] {
    while (!done.load()) take();
  });
  for (std::uint64_t tick = 0; tick < 300; ++tick)
    carveSphere(bone, {{-1.0 + 0.006 * static_cast<double>(tick), 0.0, 0.0}}, 1.0, timeErosion({}, 2e-3), tick);
  done.store(true);
  reader.join();
  take();
  EXPECT_EQ(seen, bone.solidInGridOrder());
}

TEST(CarvedBone, ABoxIsThatOfTheWholeVolumeAndAirBeyondIt) {
  const Phantom phantom = halfSpace(3.0, 0.25);
  const CarvedBone bone = phantom.bone();
  const glm::ivec3 first(1, 0, 2), size(19, 30, 9);
  const std::vector<std::uint8_t> box = bone.copyBox(first, size);
  ASSERT_EQ(box.size(), assets::countIn(size));
  assets::forVoxels(glm::ivec3(0), size, [&](glm::ivec3 at) {
    const glm::ivec3 ijk = first * 8 + at;
    EXPECT_EQ(box[assets::indexIn(size, at)], phantom.grid.contains(ijk) ? phantom.solid[phantom.grid.index(ijk)] : 0);
  });
}

}  // namespace
}  // namespace haptics
