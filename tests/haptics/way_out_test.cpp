#include "haptics/body/way_out.h"

#include <gtest/gtest.h>

#include "tests/haptics/way_out_scene.h"

namespace haptics {
namespace {

using phantom::WayOutScene;

TEST(WayOut, StraightUpFromAnOpenSlotIsFree) {
  const WayOut way = phantom::openSlot().answer();
  EXPECT_EQ(way.answer, WayOutAnswer::free);
  EXPECT_NEAR(way.length_mm, 12.0, 0.6);
  EXPECT_LT(way.turned_rad, 0.1);
  EXPECT_TRUE(way.in_the_way.empty());
}

TEST(WayOut, AsidePastASmallLedgeIsFree) {
  EXPECT_EQ(phantom::ledge(0.5).answer().answer, WayOutAnswer::free) << "0.6 mm of play";
}

TEST(WayOut, ALedgeIsNamedWithLittleMoreThanMustGo) {
  for (const double overhang_mm : {1.0, 2.0}) {
    const WayOutScene scene = phantom::ledge(overhang_mm);
    const WayOut way = scene.answer();
    // By hand, if the piece only shifts: what stands over it less the play, across its breadth. A tilt saves a little.
    const double shifted_mm3 = (overhang_mm - 0.7) * 7.5;
    EXPECT_GE(way.in_the_way_mm3, shifted_mm3 * 0.8);
    EXPECT_LE(way.in_the_way_mm3, shifted_mm3 * 1.5);
    EXPECT_NE(way.answer, WayOutAnswer::free);
    EXPECT_EQ(way.answer, way.in_the_way_mm3 < kBlocked_mm3 ? WayOutAnswer::grazes : WayOutAnswer::blocked);
    EXPECT_LT(scene.without(way.in_the_way).answer().in_the_way_mm3, kBlocked_mm3) << "it is enough";
  }
}

TEST(WayOut, UnderAClosedRoofAllOfItIsInTheWay) {
  WayOutScene scene = phantom::openSlot();
  const assets::VolumeGrid& grid = scene.bone.grid;
  double roof_mm3 = 0.0;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    if (p.z < 5.5 || p.z > 7.0) return;
    scene.bone.solid[v] = 255;
    if (std::max(std::abs(p.x), std::abs(p.y)) < 4.0) roof_mm3 += grid.voxelVolume_mm3();
  });
  const WayOut way = scene.answer();
  EXPECT_EQ(way.answer, WayOutAnswer::blocked);
  EXPECT_GT(way.in_the_way_mm3, 0.8 * roof_mm3);
  EXPECT_LT(way.in_the_way_mm3, 1.3 * roof_mm3);
  EXPECT_LT(scene.without(way.in_the_way).answer().in_the_way_mm3, kBlocked_mm3);
}

TEST(WayOut, RoundACornerUnderARoofIsFound) {
  const WayOut way = phantom::keyAndSlot().answer();
  EXPECT_NE(way.answer, WayOutAnswer::not_found);
  EXPECT_LT(way.in_the_way_mm3, kBlocked_mm3);
  EXPECT_GT(way.length_mm, 17.0);
  double most_aside_mm = 0.0;
  for (const auto& X_PQ : way.path_X_PQ)
    most_aside_mm = std::max(most_aside_mm, (X_PQ * calibration::Point<calibration::Piece>{}).mm.y);
  EXPECT_GT(most_aside_mm, 4.0);
}

TEST(WayOut, ACurvedRootTurnsOnItsWay) {
  const WayOut way = phantom::curvedRoot(false).answer();
  EXPECT_NE(way.answer, WayOutAnswer::not_found);
  EXPECT_LT(way.in_the_way_mm3, kBlocked_mm3);
  EXPECT_GT(way.turned_rad, 0.2);
}

TEST(WayOut, ALidOverACurvedRootIsNamed) {
  const WayOutScene scene = phantom::curvedRoot(true);
  const WayOut way = scene.answer();
  EXPECT_EQ(way.answer, WayOutAnswer::blocked);
  EXPECT_LT(scene.without(way.in_the_way).answer().in_the_way_mm3, kBlocked_mm3);
}

TEST(WayOut, ARoomyOneIsFoundWhereThereIsOne) {
  const WayOutScene scene = phantom::keyAndSlot();
  const WayOut way =
      findWayOut(phantom::view(scene.bone), phantom::view(scene.piece), {{0.0, 0.0, 1.0}, scene.exit_mm, true});
  EXPECT_EQ(way.answer, WayOutAnswer::grazes);
  EXPECT_LT(way.in_the_way_mm3, kBlocked_mm3);
}

TEST(WayOut, IsTheSameTwiceToTheBit) {
  const WayOut once = phantom::ledge(1.0).answer(), again = phantom::ledge(1.0).answer();
  EXPECT_EQ(once.in_the_way, again.in_the_way);
  ASSERT_EQ(once.path_X_PQ.size(), again.path_X_PQ.size());
  for (std::size_t n = 0; n < once.path_X_PQ.size(); ++n) {
    EXPECT_EQ(once.path_X_PQ[n].translation_mm, again.path_X_PQ[n].translation_mm);
    EXPECT_EQ(once.path_X_PQ[n].rotation, again.path_X_PQ[n].rotation);
  }
}

TEST(WayOut, BeginsWhereThePieceLiesAndEndsOutside) {
  const WayOut way = phantom::openSlot().answer();
  ASSERT_GE(way.path_X_PQ.size(), 2u);
  EXPECT_LT(glm::length(way.path_X_PQ.front().translation_mm), 0.01);
  EXPECT_GE(way.path_X_PQ.back().translation_mm.z, 11.5);
}

TEST(WayOut, WithoutAPieceNoneIsFound) {
  const phantom::ToothPhantom bone = phantom::boneAround(phantom::slot_mm, 6.0), none({8, 8, 8}, 0.25);
  const WayOut way = findWayOut(phantom::view(bone), phantom::view(none), {});
  EXPECT_EQ(way.answer, WayOutAnswer::not_found);
  EXPECT_TRUE(way.path_X_PQ.empty());
}

TEST(WayOut, OneVoxelInTheAirIsFree) {
  phantom::ToothPhantom air({40, 40, 80}, 0.25), voxel({1, 1, 1}, 0.25);
  voxel.solid[0] = 255;
  EXPECT_EQ(findWayOut(phantom::view(air), phantom::view(voxel), {}).answer, WayOutAnswer::free);
}

}  // namespace
}  // namespace haptics
