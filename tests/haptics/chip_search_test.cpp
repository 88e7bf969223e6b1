#include "haptics/body/chip_search.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/haptics/tooth_phantom.h"

namespace haptics {
namespace {

using phantom::ToothPhantom;

constexpr double kVoxel_mm = 0.25;
constexpr double kVoxel_mm3 = kVoxel_mm * kVoxel_mm * kVoxel_mm;

/// A block of bone with a knob of 3 x 3 x 3 voxels on a neck of one.
struct Knob {
  ToothPhantom bone{{40, 40, 40}, kVoxel_mm};
  static constexpr glm::ivec3 kLow{18, 18, 21}, kEnd{21, 21, 24}, kNeck{19, 19, 20};

  Knob() {
    phantom::fill(bone, {2, 2, 2}, {38, 38, 20});
    phantom::fill(bone, kNeck, kNeck + 1);
    phantom::fill(bone, kLow, kEnd);
  }
  Bodies bodies() const { return Bodies(bone.grid, bone.solid, {}); }
  void give(ChipSearch& search, const ToothPhantom& now) const {
    forBricks(now.grid.bricks(),
              [&](std::size_t, glm::ivec3 corner) { search.update(0, corner / 8, phantom::brickOf(now, corner / 8)); });
  }
};

std::uint64_t bytesTaken(const ChipPlan& plan) {
  std::uint64_t sum = 0;
  for (const SplitPlan& taken : plan.taken)
    for (const SplitPlan::Block& block : taken.blocks)
      sum = std::accumulate(block.given.begin(), block.given.end(), sum);
  return sum;
}

TEST(ChipSearch, FindsNothingBeforeTheNeckIsThrough) {
  const Knob knob;
  ChipSearch search{FirstBytes(knob.bodies())};
  EXPECT_TRUE(search.plan().chips.empty());
}

TEST(ChipSearch, FindsWhatCameOffToTheByte) {
  const Knob knob;
  ChipSearch search{FirstBytes(knob.bodies())};
  ToothPhantom now = knob.bone;
  phantom::fill(now, Knob::kNeck, Knob::kNeck + 1, 0);
  knob.give(search, now);
  const ChipPlan plan = search.plan();
  ASSERT_EQ(plan.chips.size(), 1u);
  const Chip& chip = plan.chips[0];
  EXPECT_EQ(chip.bone, 0u);
  EXPECT_EQ(chip.bytes, 27u * 255u);
  EXPECT_DOUBLE_EQ(chip.volume_mm3, 27.0 * kVoxel_mm3);
  EXPECT_EQ(chip.voxel, Knob::kLow);
  EXPECT_NEAR(glm::distance(chip.centroid_mm, now.grid.centre_P_mm({19, 19, 22})), 0.0, 1e-12);
  EXPECT_EQ(bytesTaken(plan), chip.bytes);
}

TEST(ChipSearch, WhatIsPartlySolidBesideAChipGoesWithIt) {
  const Knob knob;
  ChipSearch search{FirstBytes(knob.bodies())};
  ToothPhantom now = knob.bone;
  // A film of less than half on top of the knob, the rest of its neck beside the block.
  phantom::fill(now, {18, 18, 24}, {21, 21, 25}, 100);
  phantom::fill(now, Knob::kNeck, Knob::kNeck + 1, 60);
  knob.give(search, now);
  const ChipPlan plan = search.plan();
  ASSERT_EQ(plan.chips.size(), 1u);
  // The neck lies between two whole voxels: to the first of them in the order of the grid, below.
  EXPECT_EQ(plan.chips[0].bytes, 27u * 255u + 9u * 100u);
  EXPECT_EQ(bytesTaken(plan), plan.chips[0].bytes);
}

TEST(ChipSearch, IslandsOfTheScanAndPiecesOfAMillimetreAreNone) {
  Knob knob;
  phantom::fill(knob.bone, {30, 30, 30}, {32, 32, 32});  // an island
  phantom::fill(knob.bone, {5, 5, 22}, {9, 9, 26});      // 64 voxels, 1 mm³, on a neck
  phantom::fill(knob.bone, {6, 6, 20}, {7, 7, 22});
  ChipSearch search{FirstBytes(knob.bodies())};
  ToothPhantom now = knob.bone;
  phantom::fill(now, {6, 6, 20}, {7, 7, 22}, 0);
  knob.give(search, now);
  EXPECT_TRUE(search.plan().chips.empty());
  // One voxel less, and it is one.
  phantom::fill(now, {5, 5, 22}, {6, 6, 23}, 0);
  knob.give(search, now);
  EXPECT_EQ(search.plan().chips.size(), 1u);
}

TEST(ChipSearch, ChipsOfTheToothAreFoundInItsOwnVolume) {
  const Knob knob;
  std::vector<std::uint8_t> is_tooth(knob.bone.solid.size(), 0);
  assets::forVoxels(knob.bone.grid, [&](glm::ivec3 ijk, std::size_t v) { is_tooth[v] = ijk.z >= 18 ? 1 : 0; });
  const std::vector<std::uint8_t> label(is_tooth.size(), 5);
  Bodies bodies(knob.bone.grid, knob.bone.solid, label, is_tooth);
  ChipSearch search{FirstBytes(bodies)};
  EXPECT_TRUE(search.plan().chips.empty());
  // The neck, cut through in the tooth's volume.
  const glm::ivec3 first = bodies.firstBrick() * 8;
  const glm::ivec3 neck = Knob::kNeck - first;
  const SolidField field = bodies.bones()[1].field();
  std::array<std::uint8_t, kBlockVoxels> given{};
  given[SolidField::within(neck)] = 255;
  bodies.loseBlock(1, field.blockAt(SolidField::blockOf(neck)), given);
  forBricks(bodies.grid().bricks(), [&](std::size_t, glm::ivec3 corner) { giveBrick(bodies, corner / 8, search); });
  const ChipPlan plan = search.plan();
  ASSERT_EQ(plan.chips.size(), 1u);
  EXPECT_EQ(plan.chips[0].bone, 1u);
  EXPECT_EQ(plan.chips[0].voxel + first, Knob::kLow);
  EXPECT_EQ(bytesTaken(plan), plan.chips[0].bytes);
}

TEST(ChipSearch, BrickByBrickAndFromScratchAreTheSame) {
  const Knob knob;
  const FirstBytes first(knob.bodies());
  ChipSearch followed(first);
  ToothPhantom now = knob.bone;
  std::mt19937 random(7);
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  std::size_t found = 0;
  for (int round = 0; round < 40; ++round) {
    for (int n = 0; n < 60; ++n) {
      const glm::ivec3 at{2 + below(34), 2 + below(34), 12 + below(8)};
      phantom::fill(now, at, at + glm::ivec3(1 + below(3), 1 + below(3), 1), 0);
      followed.update(0, at / 8, phantom::brickOf(now, at / 8));
      const glm::ivec3 end = (at + glm::ivec3(2, 2, 0)) / 8;
      assets::forVoxels(at / 8, end + 1,
                        [&](glm::ivec3 brick) { followed.update(0, brick, phantom::brickOf(now, brick)); });
    }
    ChipSearch fresh(first);
    knob.give(fresh, now);
    const ChipPlan one = followed.plan();
    EXPECT_EQ(one, fresh.plan());
    found += one.chips.size();
    std::uint64_t sum = 0;
    for (const Chip& chip : one.chips) sum += chip.bytes;
    EXPECT_EQ(bytesTaken(one), sum);
  }
  EXPECT_GT(found, 20u);
}

}  // namespace
}  // namespace haptics
