#include "app/procedure/way_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/bone/carve.h"

namespace app {
namespace {

using assets::Tissue;

constexpr double kLidBottom_mm = 6.0;

/// A lower right third molar of 5 x 5 x 8 mm, its upper half enamel, upright in a well in bone that is open above, with
/// a play of half a millimetre; with a lid of bone 1.5 mm thick over its buccal half, or without. Frame P: buccal is
/// -x, distal y, up z.
assets::Patient wellWithMolar(bool with_lid) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{64, 64, 112}, 0.25, {-7.875, -7.875, -2.0}};
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label.assign(ct.grid.voxelCount(), static_cast<std::uint8_t>(Tissue::cortical));
  ct.tooth.assign(ct.grid.voxelCount(), 0);
  patient.site = {48, {0.0, 0.0, 4.0}, {0.0, 0.0, 1.0}};
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const double aside_mm = std::max(std::abs(p.x), std::abs(p.y));
    const bool is_tooth = aside_mm < 2.5 && p.z > -1.0 && p.z < 5.5;
    const bool is_lid = with_lid && p.x < 0.0 && aside_mm < 6.0 && p.z > kLidBottom_mm && p.z < kLidBottom_mm + 1.5;
    const bool is_wall = aside_mm > 3.0 && aside_mm < 6.0 && p.z < kLidBottom_mm;
    if (!is_tooth && !is_lid && !is_wall) return;
    ct.solid[v] = 255;
    if (!is_tooth) return;
    ct.tooth[v] = 48;
    ct.label[v] = static_cast<std::uint8_t>(p.z > 2.0 ? Tissue::enamel : Tissue::dentine);
  });
  return patient;
}

struct Watched {
  assets::Patient patient;
  haptics::Bodies bodies;
  WayWatch watch;
  haptics::Tick tick;

  explicit Watched(bool with_lid)
      : patient(wellWithMolar(with_lid)),
        bodies(patient.ct.grid, patient.ct.solid, patient.ct.label, assets::voxelsOfTooth(patient.ct, 48)),
        watch(patient, bodies) {
    tick.pieces = 1;
    tick.dt_s = 0.001;
  }
  void frame(double after_s = 0.02, bool waits = true) {
    std::vector<glm::ivec3> bricks;
    bodies.takeDirtyBricks(bricks);
    tick.t_s += after_s;
    tick.bone_digest = bodies.digest();
    watch.follow(bricks, tick, true, waits);
  }
  void cut(const glm::dvec3& at_mm, double radius_mm) {
    haptics::ErosionStep all;
    all.loss.fill(1.0);
    haptics::carveTool(bodies, {haptics::ShapeKind::sphere, radius_mm, 0.0}, {{1.0, 0.0, 0.0, 0.0}, at_mm}, all, 1);
  }
};

TEST(WayWatch, ALidOfBoneIsSaidAndShownWithinAVoxelOfIt) {
  Watched watched(true);
  watched.frame();
  EXPECT_FALSE(watched.watch.newest()) << "nobody has asked";
  watched.watch.ask();
  EXPECT_TRUE(watched.watch.isLooking());
  watched.frame();
  EXPECT_FALSE(watched.watch.isLooking());
  const auto found = watched.watch.takeNews();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->was_asked);
  ASSERT_EQ(found->pieces.size(), 1u);
  EXPECT_EQ(found->pieces[0].answer, KeptIn::held);
  const std::string words = wayInWords(*found);
  EXPECT_NE(words.find(" bone holds the tooth: "), std::string::npos) << words;
  ASSERT_FALSE(watched.watch.bone_P_mm().empty());
  double buccal_mm3 = 0.0;
  for (const Keeper& one : found->pieces[0].kept_by)
    if (one.what.find("buccal") != std::string::npos || one.what.starts_with("overlying")) buccal_mm3 += one.volume_mm3;
  EXPECT_GT(buccal_mm3, 0.7 * found->pieces[0].kept_by_mm3) << words;
  std::size_t in_lid = 0;
  for (const glm::dvec3& p : watched.watch.bone_P_mm()) {
    const glm::ivec3 ijk(glm::round(watched.patient.ct.grid.indexFromPoint(p)));
    EXPECT_GE(watched.patient.ct.solid[watched.patient.ct.grid.index(ijk)], assets::kHalfSolid) << "it is bone";
    in_lid += p.x < 0.25 && p.z > kLidBottom_mm - 0.25 && p.z < kLidBottom_mm + 1.75 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(in_lid), 0.9 * static_cast<double>(watched.watch.bone_P_mm().size()));
}

TEST(WayWatch, AFreePieceIsSaidFreeAndShowsNothing) {
  Watched watched(false);
  watched.watch.ask();
  watched.frame();
  ASSERT_TRUE(watched.watch.newest());
  EXPECT_EQ(wayInWords(*watched.watch.newest()).rfind("the tooth is free: lift it up", 0), 0u)
      << wayInWords(*watched.watch.newest());
  EXPECT_TRUE(watched.watch.bone_P_mm().empty());
}

TEST(WayWatch, LooksAgainOneSecondAfterTheLastCutAndDropsWhatIsCutAtOnce) {
  Watched watched(true);
  watched.watch.ask();
  watched.frame();
  const std::size_t shown = watched.watch.bone_P_mm().size();
  watched.watch.takeNews();
  for (const double x_mm : {-4.0, -2.0, 0.0})
    for (const double y_mm : {-5.0, -3.0, -1.0, 1.0, 3.0, 5.0}) watched.cut({x_mm, y_mm, kLidBottom_mm + 0.75}, 1.8);
  watched.frame();
  EXPECT_LT(watched.watch.bone_P_mm().size(), shown / 4) << "it is gone";
  watched.frame(0.9);
  EXPECT_FALSE(watched.watch.takeNews()) << "the hand may go on";
  watched.frame(0.2);
  const auto found = watched.watch.takeNews();
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->was_asked);
  EXPECT_NE(found->pieces[0].answer, KeptIn::held) << wayInWords(*found);
  watched.frame(5.0);
  EXPECT_FALSE(watched.watch.takeNews()) << "nothing has changed";
}

TEST(WayWatch, OfAToothThatNobodyAskedForItLooksOnceAPieceHasComeOff) {
  Watched watched(true);
  watched.frame();
  watched.frame(3.0);
  EXPECT_FALSE(watched.watch.takeNews());
  watched.tick.pieces = 2;
  watched.frame(3.0);
  EXPECT_TRUE(watched.watch.takeNews());
}

TEST(WayWatch, WhatWasFoundOfBonesThatHaveChangedIsDropped) {
  Watched watched(true);
  watched.frame();
  watched.watch.ask();
  watched.frame(0.02, false);
  EXPECT_TRUE(watched.watch.isLooking());
  watched.cut({-4.0, -4.0, 6.0}, 1.0);
  watched.frame(0.02, false);
  EXPECT_FALSE(watched.watch.isLooking()) << "it was stopped";
  // The worker may have answered already: that answer must not come.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  for (int n = 0; n < 20; ++n) watched.frame(0.02, false);
  EXPECT_FALSE(watched.watch.newest());
  // As long as it takes: the test's own limit ends it if the answer never comes.
  while (!watched.watch.newest()) {
    watched.frame(0.1, false);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(watched.watch.newest()->was_asked) << "by itself, after the change";
}

TEST(WayWatch, NothingIsAskedWhileAPieceIsInTheHandOrBytesMove) {
  Watched watched(true);
  watched.watch.ask();
  watched.tick.gripped = 1;
  watched.frame();
  EXPECT_TRUE(watched.watch.isLooking());
  EXPECT_FALSE(watched.watch.newest());
  watched.tick.gripped = 0;
  watched.tick.split = haptics::SplitAnswer::running;
  watched.frame();
  EXPECT_FALSE(watched.watch.newest());
  watched.tick.split = {};
  watched.frame();
  EXPECT_TRUE(watched.watch.newest());
}

TEST(WayWatch, AToothThatIsOutIsForgotten) {
  Watched watched(true);
  watched.watch.ask();
  watched.frame();
  ASSERT_TRUE(watched.watch.newest());
  watched.bodies.setAside(0);
  watched.tick.X_PQ[0] = watched.bodies.pose(0);
  watched.frame();
  EXPECT_FALSE(watched.watch.newest());
  EXPECT_TRUE(watched.watch.bone_P_mm().empty());
}

TEST(WayWatch, TheEndDoesNotWaitForASearch) {
  const auto seconds = [](const auto& what) {
    const auto begin = std::chrono::steady_clock::now();
    what();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  auto watched = std::make_unique<Watched>(true);
  const double search_s = seconds([&] {
    watched->watch.ask();
    watched->frame();
  });
  watched->cut({-4.0, -4.0, 6.0}, 1.0);
  watched->watch.ask();
  watched->frame(0.02, false);
  const double end_s = seconds([&] { watched.reset(); });
  std::printf("a search %.2f s, the end %.3f s\n", search_s, end_s);
  EXPECT_LT(end_s, std::max(0.6 * search_s, 0.3));
}

TEST(WayWatch, TheSameBytesGiveTheSameAnswer) {
  std::array<std::string, 2> said;
  for (std::string& words : said) {
    Watched watched(true);
    watched.watch.ask();
    watched.frame();
    words = wayText(*watched.watch.newest());
  }
  EXPECT_EQ(said[0], said[1]);
}

}  // namespace
}  // namespace app
