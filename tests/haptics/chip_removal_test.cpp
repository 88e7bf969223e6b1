#include "haptics/servo/chip_removal.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/haptics/chipped_bone.h"

namespace haptics {
namespace {

using test::ChippedBone;

std::int64_t bytesOf(const Bodies& bodies) {
  const std::vector<std::uint8_t> solid = bodies.jaw().solidInGridOrder();
  return std::accumulate(solid.begin(), solid.end(), std::int64_t{0});
}

TEST(ChipRemoval, TakesTheChipsBytesAndNoOthers) {
  ChippedBone bone;
  bone.cut();
  bone.order();
  ASSERT_EQ(bone.plan.chips.size(), 1u);
  const std::vector<std::uint8_t> before = bone.bodies.jaw().solidInGridOrder();
  const std::int64_t sum = bytesOf(bone.bodies);
  const double removed_mm3 = bone.removed_mm3;
  bone.step(20);
  ASSERT_EQ(bone.tick.chips, ChipAnswer::done);
  EXPECT_EQ(sum - bytesOf(bone.bodies), bone.plan.chips[0].bytes);
  EXPECT_NEAR(bone.removed_mm3 - removed_mm3, bone.plan.chips[0].volume_mm3, 1e-9);
  EXPECT_NEAR(bone.tick.removed_total_mm3[1], bone.removed_mm3, 1e-9);
  EXPECT_TRUE(bone.found().chips.empty());
  const std::vector<std::uint8_t> after = bone.bodies.jaw().solidInGridOrder();
  assets::forVoxels(bone.bodies.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (bone.bodies.grid().centre_P_mm(ijk).z < 0.3) {
      EXPECT_EQ(after[v], before[v]);
    }
  });
}

TEST(ChipRemoval, ComesInBoundedSteps) {
  ChippedBone bone;
  bone.cut();
  bone.order();
  // Blocks without a byte of the chip cost the same.
  while (bone.plan.taken[0].blocks.size() < 3 * ChipRemoval::kBlocksPerTick) {
    SplitPlan::Block none;
    none.block = 0;
    bone.plan.taken[0].blocks.insert(bone.plan.taken[0].blocks.begin(), none);
  }
  const std::size_t blocks = bone.plan.taken[0].blocks.size();
  int running = 0;
  for (int n = 0; n < 20 && bone.tick.chips != ChipAnswer::done; ++n) {
    bone.step();
    running += bone.tick.chips == ChipAnswer::running;
  }
  EXPECT_EQ(bone.tick.chips, ChipAnswer::done);
  EXPECT_GE(running + 1, static_cast<int>((blocks + ChipRemoval::kBlocksPerTick - 1) / ChipRemoval::kBlocksPerTick));
}

TEST(ChipRemoval, WaitsWhileTheToolTouches) {
  ChippedBone bone;
  bone.cut();
  bone.hand.X_PT.translation_mm = {-3.0, 0.0, 0.2};
  bone.step(20);
  bone.order();
  bone.step(10);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::waiting);
  bone.hand.X_PT.translation_mm.z = 4.0;
  bone.step(20);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::done);
}

TEST(ChipRemoval, IsRefusedWhereTheBodiesOrThePlanAreOthers) {
  ChippedBone bone;
  bone.cut();
  bone.order();
  bone.command.chips.bodies_digest ^= 1;
  bone.step(3);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::refused);
  bone.order();
  bone.command.chips.plan_digest ^= 1;
  bone.step(3);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::refused);
  bone.order();
  bone.command.chips.plan = nullptr;
  bone.step(3);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::refused);
  EXPECT_EQ(bone.found().chips.size(), 1u);
}

TEST(ChipRemoval, BlocksBeyondTheVolumeAreLeftOut) {
  ChippedBone bone;
  bone.cut();
  bone.order();
  SplitPlan::Block beyond;
  beyond.block = 1'000'000'000;
  beyond.given.fill(255);
  bone.plan.taken[0].blocks.push_back(beyond);
  bone.plan.taken[3].blocks.push_back(beyond);
  bone.step(20);
  EXPECT_EQ(bone.tick.chips, ChipAnswer::done);
}

TEST(ChipRemoval, ComesBackWithItsStrokeAndGoesWithItAgain) {
  ChippedBone bone;
  bone.step();
  const std::uint64_t whole = bone.bodies.digest();
  const std::vector<std::uint8_t> solid = bone.bodies.jaw().solidInGridOrder();
  bone.cut();
  ASSERT_GE(bone.tick.strokes, 1);
  const int strokes = bone.tick.strokes;
  bone.order();
  bone.step(20);
  ASSERT_EQ(bone.tick.chips, ChipAnswer::done);
  EXPECT_EQ(bone.tick.strokes, strokes);
  const std::uint64_t without = bone.bodies.digest();
  bone.command.undo_serial += static_cast<std::uint64_t>(strokes);
  ++bone.command.serial;
  bone.step(100);
  EXPECT_EQ(bone.bodies.jaw().solidInGridOrder(), solid);
  EXPECT_EQ(bone.bodies.digest(), whole);
  bone.command.redo_serial += static_cast<std::uint64_t>(strokes);
  ++bone.command.serial;
  bone.step(100);
  EXPECT_EQ(bone.bodies.digest(), without);
}

}  // namespace
}  // namespace haptics
