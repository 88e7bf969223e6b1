// What a root passes on while it is levered, and a root that breaks: a cantilever in its socket.
#include "haptics/servo/root_break.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/ligament/root_load.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/ligament_scene.h"
#include "tests/haptics/socketed_tooth.h"

namespace haptics {
namespace {

using namespace phantom;

/// Of one section alone.
RootGroups only(const RootGroups& all, std::size_t section) {
  RootGroups one = all;
  one.sections = {all.sections[section]};
  for (RootGroups::Chunk& chunk : one.chunks) chunk.beyond = chunk.beyond >> section & 1U;
  return one;
}

TEST(RootLoad, AboveTheSocketItIsWhatTheCrownBears) {
  const phantom::SocketScene scene = rootInSocket();
  const DistanceField around(scene.bone.grid, scene.bone.solid, 1.6);
  PieceHold hold = scene.hold(around);
  const RootGroups groups =
      rootGroups(rootSections(scene.piece.grid, scene.piece.solid, {}), scene.piece.grid, hold.samples());
  ASSERT_FALSE(groups.sections.empty());
  PieceDrive drive;
  drive.force_N.xyz = {5.0, 0.0, 0.0};
  drive.load_at_P.mm = {0.0, 0.0, 4.0};
  for (int n = 0; n < 1500; ++n) hold.step(drive, &around, 1e-3);
  const RootTool tool{{drive.force_N, {}}, drive.load_at_P.mm};
  double before_Nmm = 1e9;
  int looked = 0;
  for (std::size_t n = 0; n < groups.sections.size(); ++n) {
    const double at_mm = groups.sections[n].section.centre_mm.z;
    if (at_mm > 3.0) continue;
    const RootGroups one = only(groups, n);
    RootLoad load;
    std::optional<RootLoaded> loaded;
    for (std::size_t tick = 0; tick < one.chunks.size(); ++tick) {
      EXPECT_FALSE(loaded) << "a round takes all samples";
      loaded = load.follow(one, hold, &around, tool, 1e-3);
    }
    ASSERT_TRUE(loaded);
    if (at_mm > 0.0) {
      EXPECT_NEAR(loaded->force_N, 5.0, 0.15);
      EXPECT_NEAR(loaded->bending_Nmm, 5.0 * (4.0 - at_mm), 0.6) << at_mm;
      ++looked;
    } else if (at_mm < -4.0) {
      EXPECT_LT(loaded->bending_Nmm, before_Nmm) << "the ligament takes it, towards the tip ever less is left";
      before_Nmm = loaded->bending_Nmm;
    }
  }
  EXPECT_GE(looked, 1);
}

TEST(RootLoad, AnInstrumentBeyondASectionCounts) {
  const phantom::SocketScene scene = rootInSocket();
  const DistanceField around(scene.bone.grid, scene.bone.solid, 1.6);
  const PieceHold hold = scene.hold(around);
  const RootGroups one =
      only(rootGroups(rootSections(scene.piece.grid, scene.piece.solid, {}), scene.piece.grid, hold.samples()), 3);
  const glm::dvec3 at = one.sections[0].section.centre_mm;
  const auto bending_Nmm = [&](double above_mm) {
    RootLoad load;
    std::optional<RootLoaded> loaded;
    const RootTool tool{{{{2.0, 0.0, 0.0}}, {}}, at + glm::dvec3(0.0, 0.0, above_mm)};
    for (std::size_t tick = 0; tick < one.chunks.size(); ++tick) loaded = load.follow(one, hold, &around, tool, 1e-3);
    return loaded->bending_Nmm;
  };
  EXPECT_LT(bending_Nmm(3.0), 0.5) << "at rest nothing beyond it presses";
  EXPECT_NEAR(bending_Nmm(-3.0), 6.0, 0.5);
}

/// A tooth that has grown together with its bone, gripped.
struct Ankylosed : Mouth {
  Ankylosed() {
    LigamentLaw law;
    law.fibre_N_per_mm2 *= 30.0;
    std::array<PiecePose, kMaxPieces> X_PQ{};
    sites.push_back(makePieceSite(sockets.scene(0, X_PQ), first_socket, law));
    command.site = {1, bodies.digest(), 0, sites.back().get()};
    step();
    grip();
  }
  double solid() const {
    double sum = 0.0;
    for (std::size_t n = 1; n < bodies.bones().size(); ++n)
      for (const std::uint8_t byte : bodies.bones()[n].solidInGridOrder()) sum += byte;
    return sum;
  }
  /// Tilts until something breaks.
  BrokenBridge tilt(double rad) {
    const glm::dquat from = hand.X_PT.rotation;
    for (int n = 1; n <= 1500; ++n) {
      hand.X_PT.rotation = glm::slerp(from, glm::angleAxis(rad, glm::dvec3(0.0, 1.0, 0.0)), std::min(1.0, n / 800.0));
      step();
      if (tick.broken.piece != 0) return tick.broken;
    }
    return {};
  }
};

TEST(RootBreak, AnAnkylosedRootBreaksAndItsTipStays) {
  Ankylosed mouth;
  ASSERT_EQ(mouth.tick.gripped, 1);
  const double before = mouth.solid();
  const BrokenBridge broken = mouth.tilt(0.6);
  ASSERT_EQ(broken.piece, 1);
  EXPECT_TRUE(broken.is_root);
  // Round, 2.1 to 2.8 mm in radius: 60 MPa of pi r^3 / 4, less what the pull adds.
  EXPECT_GT(broken.bending_Nmm, 0.6 * 60.0 * 0.785 * std::pow(2.05, 3));
  EXPECT_LT(broken.bending_Nmm, 1.2 * 60.0 * 0.785 * std::pow(2.85, 3));
  mouth.step(100);
  EXPECT_EQ(mouth.tick.pieces, 2);
  EXPECT_EQ(mouth.tick.gripped, 0) << "the forceps hold nothing";
  EXPECT_EQ(mouth.solid(), before) << "no tooth is lost";
  EXPECT_FALSE(mouth.bodies.isSetAside(1));
  EXPECT_GT(mouth.bodies.bones()[2].solidInGridOrder().size(), 0u);
}

TEST(RootBreak, ALooseningToothTearsItsLigamentInstead) {
  Mouth mouth;
  mouth.makeReady();
  mouth.grip();
  ASSERT_EQ(mouth.tick.gripped, 1);
  const glm::dvec3 at_mm = mouth.hand.X_PT.translation_mm;
  for (int n = 0; n < 8; ++n)
    for (const double side : {1.0, -1.0}) {
      mouth.go(at_mm, 0.25, glm::angleAxis(side * (0.3 + 0.02 * n), glm::dvec3(0.0, 1.0, 0.0)));
      ASSERT_FALSE(mouth.tick.broken.is_root);
      ASSERT_EQ(mouth.tick.pieces, 1);
    }
  EXPECT_GT(mouth.tick.torn_share, 0.05);
}

TEST(RootBreak, AnUndoJoinsTheRootAgain) {
  Ankylosed mouth;
  ASSERT_TRUE(mouth.tilt(0.6).is_root);
  mouth.hand.drill_pedal = false;
  mouth.step(400);
  ASSERT_EQ(mouth.tick.pieces, 2);
  ++mouth.command.undo_serial;
  mouth.step(1500);
  EXPECT_EQ(mouth.tick.pieces, 1);
}

}  // namespace
}  // namespace haptics
