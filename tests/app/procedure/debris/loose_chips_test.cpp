#include "app/procedure/debris/loose_chips.h"

#include <gtest/gtest.h>

#include "tests/haptics/phantom.h"

namespace app {
namespace {

using haptics::phantom::filled;

/// Bone below a plane that leans by this angle about y; chips that break off where a test says.
struct Slope {
  haptics::phantom::Phantom phantom;
  haptics::Bodies bodies;
  assets::SoftTissueField soft;
  LooseChips chips;
  haptics::Tick tick;

  explicit Slope(double angle_rad = 0.0, const glm::dvec3& down = {0.0, 0.0, -1.0})
      : phantom(filled(10.0, 0.25,
                       [=](const glm::dvec3& p) { return std::cos(angle_rad) * p.z + std::sin(angle_rad) * p.x; })),
        bodies(phantom.bodies(1)),
        chips(bodies, soft, down) {
    tick.dt_s = 0.001;
  }
  void add(const glm::dvec3& at_P_mm, double volume_mm3 = 0.2) {
    haptics::ChipPlan plan;
    const glm::ivec3 voxel(glm::round(phantom.grid.indexFromPoint(at_P_mm)));
    plan.chips.push_back({0, static_cast<std::uint32_t>(volume_mm3 / phantom.grid.voxelVolume_mm3() * 255.0),
                          volume_mm3, at_P_mm, voxel});
    chips.add(plan, tick);
  }
  void run(double seconds, const std::optional<SuctionTip>& tip = {}) {
    for (int n = 0; n < static_cast<int>(1000.0 * seconds); ++n) chips.follow(tick, tip);
  }
  const LooseChip& chip(std::size_t n = 0) const { return chips.chips()[n]; }
};

TEST(LooseChips, FallOnTheBoneAndRestThere) {
  Slope floor;
  floor.add({1.0, 2.0, 5.0});
  floor.run(0.1);
  EXPECT_NEAR(floor.chip().at_P_mm.z, 5.0 - 0.1 * kChipFall_mm_per_s, 0.35);
  floor.run(1.0);
  EXPECT_TRUE(floor.chip().rests);
  EXPECT_NEAR(floor.chip().at_P_mm.z, floor.chip().radius_mm, 0.15);
  EXPECT_NEAR(floor.chip().at_P_mm.x, 1.0, 1e-9);
}

TEST(LooseChips, SlideWhereItIsSteeperThanTheirFriction) {
  const double limit_rad = std::atan(kChipFriction);
  Slope shallow(limit_rad - 0.12), steep(limit_rad + 0.15);
  for (Slope* slope : {&shallow, &steep}) {
    slope->add({-5.0, 0.0, 5.0});
    slope->run(2.0);
  }
  EXPECT_LT(std::abs(shallow.chip().at_P_mm.x + 5.0), 1.0);
  EXPECT_GT(std::abs(steep.chip().at_P_mm.x + 5.0), 3.0);
}

TEST(LooseChips, FallAsThePatientLies) {
  Slope side(0.0, {1.0, 0.0, 0.0});
  side.add({0.0, 0.0, 3.0});
  side.run(0.1);
  EXPECT_GT(side.chip().at_P_mm.x, 2.0);
  EXPECT_NEAR(side.chip().at_P_mm.z, 3.0, 1e-9);
}

TEST(LooseChips, RestOnSoftTissue) {
  Slope floor;
  floor.soft.grid = {glm::ivec3(20), 1.5, glm::dvec3(-15.0)};
  assets::forVoxels(floor.soft.grid, [&](glm::ivec3 ijk, std::size_t) {
    floor.soft.distance.push_back(assets::SoftTissueField::stored(floor.soft.grid.centre_P_mm(ijk).z - 3.0));
    floor.soft.tissue.push_back(static_cast<std::uint8_t>(assets::SoftTissue::tongue));
  });
  floor.add({1.0, 2.0, 6.0});
  floor.run(1.0);
  EXPECT_NEAR(floor.chip().at_P_mm.z, 3.0 + floor.chip().radius_mm, 0.15);
}

TEST(LooseChips, SuctionTakesThemFromFartherWithWater) {
  for (const bool water : {false, true})
    for (const double away_mm : {1.4, 3.5, 5.0}) {
      Slope floor;
      floor.add({0.0, 0.0, 0.4});
      floor.run(0.5);
      const glm::dvec3 lies = floor.chip().at_P_mm;
      floor.run(1.5, SuctionTip{lies + away_mm * glm::normalize(glm::dvec3(1.0, 0.0, 1.0)), water});
      const bool reached = away_mm < (water ? kRinsed_mm : kDry_mm);
      EXPECT_EQ(floor.chip().state, reached ? LooseChip::State::taken : LooseChip::State::loose)
          << water << " " << away_mm;
      EXPECT_EQ(floor.chips.taken().size(), reached ? 1u : 0u);
      EXPECT_EQ(floor.chips.left().size(), reached ? 0u : 1u);
    }
}

TEST(LooseChips, SuctionDoesNotReachThroughBone) {
  Slope wall(0.5 * 3.14159265358979);  // bone at x < 0
  const SuctionTip beyond{{-3.0, 0.0, 0.0}, true};
  wall.add({0.4, 0.0, 0.0});
  for (int n = 0; n < 20; ++n) wall.chips.follow(wall.tick, beyond);
  EXPECT_EQ(wall.chip().state, LooseChip::State::loose);
}

/// Where a chip broke off, full and empty, as undo and redo leave it.
struct BreakingPlace {
  Slope& floor;
  glm::ivec3 voxel = floor.chip().chip.voxel;
  std::size_t block = floor.bodies.jaw().field().blockAt(haptics::SolidField::blockOf(voxel));
  haptics::BlockState empty = floor.bodies.jaw().stateOf(block), full = empty;
  std::vector<glm::ivec3> brick{voxel / 8};

  explicit BreakingPlace(Slope& of) : floor(of) { full.solid[haptics::SolidField::within(voxel)] = 255; }

  void become(const haptics::BlockState& state, double restored_mm3, int undone_strokes) {
    floor.bodies.bones()[0].restoreBlock(block, state);
    floor.tick.restored_total_mm3 = restored_mm3;
    floor.tick.undone_strokes = static_cast<std::uint8_t>(undone_strokes);
    floor.chips.followBone(brick, floor.tick);
  }
};

TEST(LooseChips, GoBackIntoTheBoneWithAnUndoAndComeLooseWithTheRedo) {
  Slope floor;
  // In the air, as after its removal.
  floor.add({0.0, 0.0, 4.0});
  floor.run(1.0);
  BreakingPlace place(floor);
  place.become(place.full, 0.2, 1);
  EXPECT_EQ(floor.chip().state, LooseChip::State::in_bone);
  EXPECT_TRUE(floor.chips.left().empty());

  place.become(place.empty, 0.0, 0);
  EXPECT_EQ(floor.chip().state, LooseChip::State::loose);
  EXPECT_NEAR(floor.chip().at_P_mm.z, 4.0, 1e-9);
}

TEST(LooseChips, WhatABurCutsAfterAnUndoIsNoChip) {
  Slope floor;
  floor.add({0.0, 0.0, 4.0});
  BreakingPlace place(floor);
  place.become(place.full, 0.2, 1);
  // Cut anew: nothing is left to redo, and what was restored stays restored.
  place.become(place.empty, 0.2, 0);
  EXPECT_TRUE(floor.chips.chips().empty());
}

TEST(LooseChips, GoTheSameWayEveryTime) {
  const auto end = [] {
    Slope slope(0.9);
    for (int n = 0; n < 12; ++n) slope.add({-6.0 + n, 0.3 * n, 7.0 - 0.4 * n}, 0.02 + 0.07 * n);
    slope.run(1.3, SuctionTip{{1.0, 1.0, 0.0}, true});
    std::vector<glm::dvec3> places;
    for (const LooseChip& chip : slope.chips.chips()) places.push_back(chip.at_P_mm);
    return places;
  };
  EXPECT_EQ(end(), end());
}

}  // namespace
}  // namespace app
