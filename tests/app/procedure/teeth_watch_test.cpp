#include "app/procedure/teeth_watch.h"

#include "haptics/body/bridge_break.h"
#include "haptics/body/bridge_strength.h"
#include "haptics/body/piece_split.h"
#include "tests/haptics/tooth_phantom.h"

namespace app {
namespace {

using haptics::phantom::brickOf;
using haptics::phantom::bridged;
using haptics::phantom::ToothPhantom;

void giveAll(TeethWatch& watch, const ToothPhantom& tooth) {
  assets::forVoxels(glm::ivec3(0), tooth.grid.bricks(),
                    [&](glm::ivec3 brick) { watch.give(brick, brickOf(tooth, brick)); });
}

TEST(TeethWatch, FindsTheBridgeAndThenTwoPieces) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false);
  TeethWatch watch(whole.grid, whole.solid);
  EXPECT_EQ(watch.newest().serial, 0u);
  giveAll(watch, bridged(0.3, 0.0, 1.5, 6.0, true));
  watch.settle();
  const TeethWatch::Report& held = watch.newest();
  EXPECT_TRUE(held.has_bridges);
  EXPECT_EQ(held.findings.pieces, 1u);
  ASSERT_EQ(held.findings.held[0].bridges, 1u);
  EXPECT_NEAR(held.findings.held[0].bridge[0].area_mm2, 9.0, 0.5);

  giveAll(watch, bridged(0.3, 0.0, 0.0, 0.0, true));
  watch.settle();
  EXPECT_EQ(watch.newest().findings.pieces, 2u);
}

TEST(TeethWatch, WhateverTheOrderOfBricksTheFindingsAreThoseOfTheLastBytes) {
  const ToothPhantom whole = bridged(0.3, 0.3, 1.5, 6.0, false), now = bridged(0.3, 0.3, 1.5, 6.0, true);
  TeethWatch once(whole.grid, whole.solid), often(whole.grid, whole.solid);
  giveAll(once, now);
  for (const double thickness_mm : {5.0, 4.0, 3.0, 2.0}) giveAll(often, bridged(0.3, 0.3, thickness_mm, 6.0, true));
  giveAll(often, now);
  once.settle();
  often.settle();
  const haptics::ToothFindings &a = once.newest().findings, &b = often.newest().findings;
  EXPECT_EQ(a.piece[0].volume_mm3, b.piece[0].volume_mm3);
  ASSERT_EQ(a.held[0].bridges, b.held[0].bridges);
  EXPECT_EQ(a.held[0].bridge[0].area_mm2, b.held[0].bridge[0].area_mm2);
  EXPECT_EQ(a.held[0].bridge[0].centre_mm, b.held[0].bridge[0].centre_mm);
}

TEST(TeethWatch, SaysOnceWhatComesOffAndOnlyOfAConfirmedState) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false);
  TeethWatch watch(whole.grid, whole.solid);
  giveAll(watch, bridged(0.3, 0.0, 1.5, 6.0, true));
  watch.confirm(6);
  watch.settle();
  EXPECT_FALSE(watch.takeParting()) << "held by a bridge";
  const ToothPhantom parted = bridged(0.3, 0.0, 0.0, 0.0, true);
  giveAll(watch, parted);
  watch.settle();
  EXPECT_FALSE(watch.takeParting()) << "it may still change";
  watch.confirm(7);
  watch.settle();
  const auto parting = watch.takeParting();
  ASSERT_TRUE(parting);
  EXPECT_EQ(parting->digest, 7u);
  EXPECT_EQ(parting->plan, haptics::partingPlan({parted.grid, parted.solid}));
  EXPECT_FALSE(watch.takeParting());
  watch.confirm(7);
  watch.settle();
  EXPECT_FALSE(watch.takeParting()) << "once for a state";
  // What is given later makes an older answer void.
  giveAll(watch, parted);
  watch.confirm(8);
  watch.settle();
  giveAll(watch, parted);
  EXPECT_FALSE(watch.takeParting());
}

TEST(TeethWatch, PlansTheBreakOfABridgeOnceWhereItIsAsked) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false), held = bridged(0.3, 0.0, 1.5, 6.0, true);
  TeethWatch watch(whole.grid, whole.solid);
  giveAll(watch, held);
  watch.confirm(6);
  watch.settle();
  EXPECT_FALSE(watch.takeBreak()) << "nobody asked";
  watch.planBreaks(true);
  watch.settle();
  const auto plan = watch.takeBreak();
  ASSERT_TRUE(plan);
  EXPECT_NEAR(plan->bridge.area_mm2, 9.0, 0.5);
  EXPECT_EQ(*plan, haptics::breakPlan({held.grid, held.solid}, {}, plan->bridge));
  watch.confirm(7);
  watch.settle();
  EXPECT_FALSE(watch.takeBreak()) << "the piece lies elsewhere, its bytes are the same";
  giveAll(watch, whole);
  watch.confirm(8);
  watch.settle();
  EXPECT_FALSE(watch.takeBreak()) << "there is no bridge";
  giveAll(watch, bridged(0.3, 0.0, 0.0, 0.0, true));
  watch.confirm(9);
  watch.settle();
  EXPECT_FALSE(watch.takeBreak()) << "it has fallen apart";
  EXPECT_TRUE(watch.takeParting());
}

TEST(TeethWatch, EndsWithBricksNotYetLookedAt) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false);
  TeethWatch watch(whole.grid, whole.solid);
  giveAll(watch, whole);
}

}  // namespace
}  // namespace app
