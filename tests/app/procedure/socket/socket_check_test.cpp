#include "app/procedure/socket/socket_check.h"

#include <gtest/gtest.h>

#include "tests/app/procedure/socket/socket_scene.h"

namespace app {
namespace {

using test::SocketScene;

TEST(SocketCheck, FindsNothingWhereNothingWasDone) {
  SocketScene scene;
  scene.tooth = scene.before;
  for (std::size_t v = 0; v < scene.tooth.size(); ++v)
    if (scene.jaw[v] != 0) scene.tooth[v] = 0;
  const SocketRecord found = scene.found().record;
  ASSERT_EQ(found.retained.size(), 1u);
  EXPECT_NEAR(found.retained[0].amount, 6.0 * 6.0 * 12.0, 1e-9);
  EXPECT_EQ(found.canal.amount, 0.0);
  EXPECT_TRUE(found.lingual.empty());
  EXPECT_TRUE(found.edges.empty());
}

TEST(SocketCheck, AnEmptySocketWithSquareWallsHasItsRimForAnEdge) {
  const SocketScene scene;
  const SocketRecord found = scene.found().record;
  EXPECT_TRUE(found.retained.empty());
  EXPECT_EQ(found.canal.amount, 0.0);
  EXPECT_TRUE(found.lingual.empty());
  EXPECT_NEAR(sumOf(found.edges), 4.0 * 6.0, 1.5);
  EXPECT_FALSE(found.isClean());
}

TEST(SocketCheck, CountsTwoIslandsOfRootAndNoChip) {
  SocketScene scene;
  scene.fill(scene.tooth, {{-3.0, -3.0, -10.0}, {-1.0, -1.0, -8.0}}, 255);
  scene.fill(scene.tooth, {{1.0, 1.0, -10.0}, {2.0, 2.0, -7.0}}, 255);
  scene.fill(scene.tooth, {{1.0, -2.0, -10.0}, {2.0, -1.5, -9.0}}, 255);
  const SocketRecord found = scene.found().record;
  ASSERT_EQ(found.retained.size(), 2u);
  EXPECT_NEAR(found.retained[0].amount, 8.0, 1e-9);
  EXPECT_NEAR(found.retained[1].amount, 3.0, 1e-9);
  EXPECT_NEAR(glm::distance(found.retained[0].centre_P_mm, glm::dvec3(-2.0, -2.0, -9.0)), 0.0, 1e-9);
  EXPECT_FALSE(found.isClean());
}

TEST(SocketCheck, MeasuresTheCanalThatIsLaidOpen) {
  SocketScene scene;
  scene.drill({{-1.0, -1.0, -11.0}, {1.0, 1.0, -9.0}});
  const SocketRecord found = scene.found().record;
  EXPECT_NEAR(found.canal.amount, 4.0, 1e-9);
  EXPECT_EQ(found.canal_by_root_mm2, 0.0) << "bone was over it";
  // A last voxel of it that was mostly the tooth's.
  scene.fill(scene.before_jaw, {{-1.0, -1.0, -11.0}, {1.0, 1.0, -10.75}}, 120);
  EXPECT_NEAR(scene.found().record.canal_by_root_mm2, 4.0, 1e-9);
  EXPECT_NEAR(glm::distance(found.canal.centre_P_mm, glm::dvec3(0.0, 0.0, -11.125)), 0.0, 1e-9);
}

TEST(SocketCheck, ALigamentBetweenRootAndCanalHidesNothing) {
  SocketScene scene;
  const SocketScene::Box lining{{-1.0, -1.0, -11.0}, {1.0, 1.0, -10.5}};
  const SocketScene::Box root{{-1.0, -1.0, -10.5}, {1.0, 1.0, -10.0}};
  for (auto* solid : {&scene.jaw, &scene.before}) scene.fill(*solid, lining, 0);
  scene.fill(scene.label, lining, static_cast<std::uint8_t>(assets::Tissue::ligament));
  scene.fill(scene.label, root, static_cast<std::uint8_t>(assets::Tissue::dentine));
  scene.fill(scene.jaw, root, 0);
  EXPECT_NEAR(scene.found().record.canal.amount, 4.0, 1e-9);
  EXPECT_NEAR(scene.found().record.canal_by_root_mm2, 4.0, 1e-9);
  // With the root in its place it is covered.
  scene.fill(scene.tooth, root, 255);
  EXPECT_EQ(scene.found().record.canal.amount, 0.0);
}

TEST(SocketCheck, MeasuresAHoleInTheLingualPlate) {
  SocketScene scene;
  scene.drill({{2.0, -1.0, -6.0}, {7.0, 1.0, -4.0}});
  const SocketRecord found = scene.found().record;
  ASSERT_EQ(found.lingual.size(), 1u);
  EXPECT_NEAR(found.lingual[0].amount, 4.0, 1e-9);
  EXPECT_NEAR(glm::distance(found.lingual[0].centre_P_mm, glm::dvec3(5.875, 0.0, -5.0)), 0.0, 1e-9);
}

TEST(SocketCheck, APlateThatWasMostlyTheToothsIsNoHoleOnceTheToothIsOut) {
  SocketScene scene;
  const SocketScene::Box plate{{2.0, -1.0, -6.0}, {7.0, 1.0, -4.0}};
  scene.drill(plate);
  scene.fill(scene.before_jaw, plate, 120);
  EXPECT_TRUE(scene.found().record.lingual.empty());
  scene.fill(scene.before_jaw, plate, 130);
  EXPECT_EQ(scene.found().record.lingual.size(), 1u);
}

TEST(SocketCheck, AScratchOnTheLingualPlateIsNoHole) {
  SocketScene scene;
  scene.drill({{5.0, -1.0, -6.0}, {7.0, 1.0, -4.0}});
  EXPECT_TRUE(scene.found().record.lingual.empty());
}

TEST(SocketCheck, WhatWasOpenBeforeIsNoHole) {
  SocketScene scene;
  const SocketScene::Box opening{{2.0, -1.0, -6.0}, {7.0, 1.0, -4.5}};
  scene.drill(opening);
  scene.fill(scene.before, opening, 0);
  EXPECT_TRUE(scene.found().record.lingual.empty());
}

TEST(SocketCheck, SaysTheSameOfTheSame) {
  SocketScene scene;
  scene.drill({{2.0, -1.0, -6.0}, {7.0, 1.0, 0.0}});
  EXPECT_EQ(scene.found().record, scene.found().record);
}

}  // namespace
}  // namespace app
