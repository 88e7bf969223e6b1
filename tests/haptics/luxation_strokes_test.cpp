#include "haptics/servo/luxation_strokes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "haptics/body/piece_split.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/socketed_tooth.h"

namespace haptics {
namespace {

using namespace phantom;

/// The mouth with what is done in it, and what is compared.
struct Operation : Mouth {
  SplitPlan plan;

  void bur() {
    command.tool = {{ShapeKind::sphere, 0.5, 0.0}, {}, true, false};
    ++command.serial;
    step(5);
  }
  void forceps() {
    command.tool = forcepsTool();
    ++command.serial;
    step(5);
  }
  /// Down to `z_mm` and up again: one stroke.
  void cutAt(double x_mm, double z_mm) {
    bur();
    go({x_mm, 0.0, z_mm + 2.0}, 0.1);
    hand.drill_pedal = true;
    go({x_mm, 0.0, z_mm}, 0.4);
    go({x_mm, 0.0, z_mm + 2.0}, 0.1);
    hand.drill_pedal = false;
    step(400);
    go({12.0, 0.0, 6.0}, 0.1);
  }
  void cutBone() { cutAt(6.0, -0.6); }
  void cutTooth() { cutAt(0.0, 3.2); }
  /// Rocked and let go of, the hand out of the way. Begins beside the crown, wherever that is.
  void luxate(double rad) {
    forceps();
    makeReady();
    ASSERT_EQ(tick.site, SiteAnswer::ready);
    go({2.0, 0.0, 2.0}, 0.1);
    hand.drill_pedal = true;
    step();
    ASSERT_EQ(tick.gripped, 1);
    const glm::dvec3 at_mm = hand.X_PT.translation_mm;
    for (const double side : {1.0, -1.0}) go(at_mm, 0.2, glm::angleAxis(side * rad, glm::dvec3(0.0, 1.0, 0.0)));
    release();
    go({12.0, 0.0, 6.0}, 0.1, {1.0, 0.0, 0.0, 0.0});
  }
  void undo(std::uint64_t strokes = 1) {
    command.undo_serial += strokes;
    ++command.serial;
  }
  void redo(std::uint64_t strokes = 1) {
    command.redo_serial += strokes;
    ++command.serial;
  }
  void undoAndWait() { undo(), step(30); }
  void redoAndWait() { redo(), step(30); }

  /// One half of the tooth comes off.
  void part() {
    const CarvedBone& tooth = bodies.bones()[1];
    std::vector<std::uint8_t> half = tooth.solidInGridOrder();
    assets::forVoxels(tooth.grid(), [&](glm::ivec3 ijk, std::size_t v) {
      if (tooth.grid().centre_P_mm(ijk).x > 0.0) half[v] = 0;
    });
    plan = splitPlan(tooth.grid(), half);
    command.split = {command.split.serial + 1, bodies.digest(), 0, &plan};
    ++command.serial;
    step(60);
    ASSERT_EQ(tick.split, SplitAnswer::done);
  }
  const PieceState& state() const { return sites.back()->hold.state(); }
};

bool isSame(const PiecePose& a, const PiecePose& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expectSame(const PieceState& a, const PieceState& b) {
  EXPECT_TRUE(isSame(a.X_PQ, b.X_PQ));
  EXPECT_EQ(a.ligament.torn, b.ligament.torn);
  EXPECT_EQ(a.ligament.fluid_N_per_mm2, b.ligament.fluid_N_per_mm2);
  EXPECT_EQ(a.ligament.strain, b.ligament.strain);
  EXPECT_EQ(a.ligament.widened_mm, b.ligament.widened_mm);
}

TEST(LuxationStrokes, AGripIsAStrokeUndoneAndRedoneToTheBit) {
  Operation at;
  at.luxate(0.12);
  const PieceState first = at.state();
  const std::uint64_t before = at.bodies.digest();
  const PiecePose X_PQ = at.bodies.pose(0);
  const double torn_Nmm = at.tick.torn_total_Nmm, torn_share = at.tick.torn_share;
  at.luxate(0.14);
  EXPECT_EQ(at.tick.strokes, 2);
  const PieceState second = at.state();
  const std::uint64_t after = at.bodies.digest();
  const double more_Nmm = at.tick.torn_total_Nmm, more_share = at.tick.torn_share;
  ASSERT_NE(before, after);
  ASSERT_GT(more_Nmm, torn_Nmm);
  ASSERT_GT(more_share, torn_share);
  for (int n = 0; n < 3; ++n) {
    at.undo();
    at.step();
    EXPECT_EQ(at.tick.bone_digest, before) << "in one tick";
    EXPECT_EQ(at.tick.strokes, 1);
    EXPECT_EQ(at.tick.undone_strokes, 1);
    EXPECT_EQ(at.tick.torn_total_Nmm, torn_Nmm);
    EXPECT_NEAR(at.tick.torn_share, torn_share, 1e-6);
    EXPECT_TRUE(isSame(at.tick.X_PQ[0], X_PQ));
    expectSame(at.state(), first);
    EXPECT_EQ(at.tick.removed_mm3, 0.0);
    EXPECT_EQ(at.tick.restored_total_mm3, 0.0);
    at.step(100);
    EXPECT_EQ(at.tick.bone_digest, before) << "it rests";
    at.redo();
    at.step();
    EXPECT_EQ(at.tick.bone_digest, after);
    EXPECT_EQ(at.tick.torn_total_Nmm, more_Nmm);
    EXPECT_NEAR(at.tick.torn_share, more_share, 1e-6);
    EXPECT_EQ(at.tick.undone_strokes, 0);
    expectSame(at.state(), second);
  }
  // Both at once, in two ticks.
  at.undo(2);
  at.step();
  EXPECT_EQ(at.tick.drill_inhibit, DrillInhibit::undo_running);
  at.step();
  EXPECT_EQ(at.tick.strokes, 0);
  EXPECT_EQ(at.tick.torn_total_Nmm, 0.0);
  EXPECT_TRUE(at.bodies.isAtRest(0));
}

TEST(LuxationStrokes, APieceThatWasPutBackTearsAsItDidBefore) {
  Operation at;
  at.luxate(0.12);
  at.undoAndWait();
  at.makeReady();
  Operation fresh;
  at.luxate(0.13);
  fresh.luxate(0.13);
  expectSame(at.state(), fresh.state());
  EXPECT_EQ(at.tick.torn_total_Nmm, fresh.tick.torn_total_Nmm);
  EXPECT_EQ(at.bodies.digest(), fresh.bodies.digest());
}

TEST(LuxationStrokes, StrokesOfBothKindsAreUndoneAndRedoneInOrder) {
  Operation at;
  std::vector<std::uint64_t> digests{at.bodies.digest()};
  std::vector<int> strokes{0};
  std::vector<double> removed_mm3{0.0};
  const auto note = [&] {
    digests.push_back(at.bodies.digest());
    strokes.push_back(at.tick.strokes);
    removed_mm3.push_back(at.tick.removed_total_mm3[1] + at.tick.removed_total_mm3[5]);
  };
  at.cutBone(), note();
  at.luxate(0.12), note();
  at.cutTooth(), note();
  at.luxate(0.13), note();
  at.cutBone(), note();
  for (std::size_t n = 1; n < digests.size(); ++n) ASSERT_GT(strokes[n], strokes[n - 1]);
  const double torn_Nmm = at.tick.torn_total_Nmm;
  for (std::size_t n = digests.size() - 1; n > 0; --n) {
    at.undo(static_cast<std::uint64_t>(strokes[n] - strokes[n - 1]));
    at.step(40);
    EXPECT_EQ(at.bodies.digest(), digests[n - 1]) << n;
    EXPECT_EQ(at.tick.strokes, strokes[n - 1]);
    const auto now_mm3 = at.bodies.removedByTissue_mm3();
    EXPECT_NEAR(now_mm3[1] + now_mm3[5], removed_mm3[n - 1], 1e-9);
    EXPECT_NEAR(at.tick.restored_total_mm3, removed_mm3.back() - removed_mm3[n - 1], 1e-9);
  }
  EXPECT_EQ(at.tick.torn_total_Nmm, 0.0);
  for (std::size_t n = 1; n < digests.size(); ++n) {
    at.redo(static_cast<std::uint64_t>(strokes[n] - strokes[n - 1]));
    at.step(40);
    EXPECT_EQ(at.bodies.digest(), digests[n]) << n;
  }
  EXPECT_EQ(at.tick.torn_total_Nmm, torn_Nmm);
  EXPECT_NEAR(at.tick.restored_total_mm3, 0.0, 1e-9);
  // All at once, and back.
  at.undo(200);
  at.step(100);
  EXPECT_EQ(at.bodies.digest(), digests.front());
  at.redo(200);
  at.step(100);
  EXPECT_EQ(at.bodies.digest(), digests.back());
}

/// The site of the cut tooth has other samples: what the whole one remembered waits.
TEST(LuxationStrokes, WhatALigamentRemembersWaitsForASiteOfTheSamePiece) {
  Operation at;
  at.luxate(0.12);
  const PieceState first = at.state();
  const std::uint64_t before = at.bodies.digest();
  at.luxate(0.14);
  const PieceState second = at.state();
  const std::uint64_t after = at.bodies.digest();
  const int strokes = at.tick.strokes;
  at.cutTooth();
  at.forceps();
  at.makeReady();
  ASSERT_NE(at.state().ligament.torn, second.ligament.torn);
  // Back to before the second grip.
  at.undo(static_cast<std::uint64_t>(at.tick.strokes - strokes + 1));
  at.step(60);
  ASSERT_EQ(at.bodies.digest(), before);
  const double torn_share = at.tick.torn_share;
  at.grip();
  EXPECT_EQ(at.tick.gripped, 0) << "not ready";
  at.release(5);
  at.makeReady();
  ASSERT_EQ(at.tick.site, SiteAnswer::ready);
  expectSame({first.X_PQ, at.state().ligament}, first);
  EXPECT_TRUE(isSame(at.state().X_PQ, at.bodies.pose(0)));
  EXPECT_NEAR(at.sites.back()->hold.tornShare(), torn_share, 1e-6);
  // And to after it, whatever is in force.
  at.redoAndWait();
  EXPECT_EQ(at.bodies.digest(), after);
  expectSame(at.state(), second);
  at.grip();
  EXPECT_EQ(at.tick.gripped, 1);
}

TEST(LuxationStrokes, ACutIntoTheToothThatIsUndoneLeavesItsLigamentAsTheGripDid) {
  Operation at;
  at.luxate(0.14);
  const PieceState left = at.state();
  const std::uint64_t before = at.bodies.digest();
  const int strokes = at.tick.strokes;
  at.cutTooth();
  at.forceps();
  at.makeReady();
  ASSERT_NE(at.state().ligament.torn, left.ligament.torn);
  at.undo(static_cast<std::uint64_t>(at.tick.strokes - strokes));
  at.step(60);
  ASSERT_EQ(at.bodies.digest(), before);
  at.makeReady();
  expectSame({left.X_PQ, at.state().ligament}, left);
  EXPECT_TRUE(isSame(at.state().X_PQ, at.bodies.pose(0)));
}

/// The site of the cut tooth is in force all the time: the desk orders none. What waited for the whole tooth is of no
/// more use, neither to undo the next grip nor when the tooth is cut once more.
TEST(LuxationStrokes, ACutThatIsRedoneFindsItsSiteReady) {
  for (const bool undone : {true, false}) {
    Operation at;
    at.luxate(0.14);
    const int strokes = at.tick.strokes;
    at.cutTooth();
    const auto cuts = static_cast<std::uint64_t>(at.tick.strokes - strokes);
    at.forceps();
    at.makeReady();
    const PieceState cut = at.state();
    const std::uint64_t digest = at.bodies.digest();
    at.undo(1 + cuts);
    at.step(60);
    ASSERT_EQ(at.tick.torn_total_Nmm, 0.0);
    at.redo(1 + cuts);
    at.step(60);
    ASSERT_EQ(at.bodies.digest(), digest);
    expectSame(at.state(), cut);
    at.go({2.0, 0.0, 2.0}, 0.1);
    at.hand.drill_pedal = true;
    at.step();
    ASSERT_EQ(at.tick.gripped, 1);
    at.go({2.0, 0.0, 9.0}, 0.3);
    at.go({2.0, 0.0, 2.0}, 0.3);
    at.release();
    const double torn_share = at.sites.back()->hold.tornShare();
    ASSERT_GT(torn_share, 0.5);
    if (undone) {
      at.undoAndWait();
      EXPECT_EQ(at.bodies.digest(), digest);
      expectSame(at.state(), cut);
    } else {
      at.cutAt(0.3, 2.8);
      at.forceps();
      at.makeReady();
      ASSERT_NE(at.state().ligament.torn.size(), 0u);
      EXPECT_GE(at.sites.back()->hold.tornShare(), torn_share - 1e-6);
    }
  }
}

TEST(LuxationStrokes, AStateThatWaitsIsTheMeanForAPieceThatWasCutInstead) {
  Operation at;
  at.luxate(0.12);
  at.luxate(0.14);
  const double torn_share = at.tick.torn_share;
  const int strokes = at.tick.strokes;
  at.cutTooth();
  at.forceps();
  at.makeReady();
  at.undo(static_cast<std::uint64_t>(at.tick.strokes - strokes + 1));
  at.step(60);
  const double before_share = at.tick.torn_share;
  ASSERT_LT(before_share, torn_share);
  at.cutTooth();
  at.forceps();
  at.makeReady();
  const std::vector<float>& torn = at.state().ligament.torn;
  EXPECT_NEAR(*std::ranges::min_element(torn), before_share, 1e-6);
}

TEST(LuxationStrokes, APieceThatWasSetAsideComesBack) {
  Operation at;
  at.luxate(0.3);
  const std::uint64_t before = at.bodies.digest();
  at.makeReady();
  const PieceState first = at.state();
  at.go({2.0, 0.0, 2.0}, 0.1);
  at.hand.drill_pedal = true;
  at.step();
  ASSERT_EQ(at.tick.gripped, 1);
  at.rockOut(0.6);
  at.release(5);
  ASSERT_TRUE(at.bodies.isSetAside(0));
  ASSERT_EQ(at.tick.strokes, 2);
  const std::uint64_t out = at.bodies.digest();
  at.undoAndWait();
  EXPECT_EQ(at.bodies.digest(), before);
  EXPECT_FALSE(at.bodies.isSetAside(0));
  expectSame(at.state(), first);
  at.redoAndWait();
  EXPECT_TRUE(at.bodies.isSetAside(0));
  EXPECT_EQ(at.bodies.digest(), out);
  at.undoAndWait();
  at.hand.X_PT.rotation = {1.0, 0.0, 0.0, 0.0};
  at.go({2.0, 0.0, 2.0}, 0.1);
  at.grip();
  EXPECT_EQ(at.tick.gripped, 1) << "its site still holds";
}

TEST(LuxationStrokes, ASplitAfterAGripIsUndoneWithIt) {
  Operation at;
  at.cutBone();
  at.luxate(0.12);
  const std::uint64_t cut = [&] {
    at.undoAndWait();
    const std::uint64_t digest = at.bodies.digest();
    at.redoAndWait();
    return digest;
  }();
  const int strokes = at.tick.strokes;
  at.part();
  EXPECT_EQ(at.tick.strokes, strokes);
  ASSERT_EQ(at.tick.pieces, 2);
  const std::uint64_t parted = at.bodies.digest();
  const PiecePose X_PQ = at.bodies.pose(1);
  ASSERT_FALSE(at.bodies.isAtRest(1));
  // A grip of the new piece after it, too.
  at.makeReady(1);
  ASSERT_EQ(at.tick.site, SiteAnswer::ready);
  at.go({1.6, 0.0, 2.0}, 0.1);
  at.hand.drill_pedal = true;
  at.go({1.6, 0.0, 3.0}, 0.3);
  ASSERT_EQ(at.tick.gripped, 2);
  at.release();
  const std::uint64_t pulled = at.bodies.digest();
  ASSERT_NE(pulled, parted);
  at.undoAndWait();
  EXPECT_EQ(at.bodies.digest(), parted);
  at.undoAndWait();
  EXPECT_EQ(at.tick.pieces, 1);
  EXPECT_EQ(at.bodies.digest(), cut);
  EXPECT_EQ(at.tick.strokes, strokes - 1);
  at.redoAndWait();
  EXPECT_EQ(at.bodies.digest(), parted);
  EXPECT_TRUE(isSame(at.bodies.pose(1), X_PQ));
  at.redoAndWait();
  EXPECT_EQ(at.bodies.digest(), pulled);
  // Turned back in the middle.
  at.undoAndWait();
  at.undo();
  at.step();
  at.redo();
  at.step(60);
  EXPECT_EQ(at.bodies.digest(), parted);
}

TEST(LuxationStrokes, ASplitBeforeAGripStaysWithTheStrokeOfTheBur) {
  Operation at;
  at.cutBone();
  const int strokes = at.tick.strokes;
  at.part();
  const std::uint64_t parted = at.bodies.digest();
  at.forceps();
  at.makeReady(0);
  at.makeReady(1);
  ASSERT_EQ(at.tick.site, SiteAnswer::ready);
  at.go({-1.6, 0.0, 2.0}, 0.1);
  at.hand.drill_pedal = true;
  at.go({-1.6, 0.0, 6.0}, 0.5);
  ASSERT_EQ(at.tick.gripped, 2);
  at.release();
  const std::uint64_t pulled = at.bodies.digest();
  EXPECT_EQ(at.tick.strokes, strokes + 1);
  at.undoAndWait();
  EXPECT_EQ(at.bodies.digest(), parted);
  at.undoAndWait();
  EXPECT_EQ(at.tick.pieces, 1);
  at.redoAndWait();
  EXPECT_EQ(at.bodies.digest(), parted);
  at.redoAndWait();
  EXPECT_EQ(at.bodies.digest(), pulled);
}

TEST(LuxationStrokes, AToolInAPieceThatIsPutBackIsEmbedded) {
  Operation at;
  at.makeReady();
  at.grip();
  at.rockOut(0.6);
  at.release(5);
  ASSERT_TRUE(at.bodies.isSetAside(0));
  // The bur turns in the empty place of the crown.
  at.bur();
  at.hand.X_PT.rotation = {1.0, 0.0, 0.0, 0.0};
  at.go({0.0, 0.0, 10.0}, 0.2);
  at.go({0.0, 0.0, 2.0}, 0.3);
  at.hand.drill_pedal = true;
  at.step(20);
  ASSERT_TRUE(at.tick.drilling);
  at.undo();
  at.step();
  EXPECT_FALSE(at.bodies.isSetAside(0));
  EXPECT_FALSE(at.tick.drilling);
  EXPECT_EQ(at.tick.drill_inhibit, DrillInhibit::tool_embedded);
  EXPECT_EQ(at.tick.removed_mm3, 0.0);
  for (int n = 0; n < 100; ++n) {
    at.step();
    ASSERT_EQ(at.tick.drill_inhibit, DrillInhibit::tool_embedded);
    ASSERT_LT(glm::length(at.tick.commanded_force_P_N.xyz), 1e-9);
  }
  at.go({0.0, 0.0, 10.0}, 0.3);
  EXPECT_EQ(at.tick.drill_inhibit, DrillInhibit::pedal_held);
  EXPECT_EQ(at.tick.removed_total_mm3[5], 0.0);
  at.release(1);
  EXPECT_EQ(at.tick.drill_inhibit, DrillInhibit::none);
}

TEST(LuxationStrokes, BeaksAroundAPieceThatIsPutBackOpenFirst) {
  Operation at;
  at.makeReady();
  at.grip();
  at.rockOut(0.6);
  at.release(5);
  ASSERT_TRUE(at.bodies.isSetAside(0));
  at.go({2.0, 0.0, 10.0}, 0.2, {1.0, 0.0, 0.0, 0.0});
  at.go({2.0, 0.0, 2.0}, 0.3);
  // Closed before and while it comes back.
  at.hand.drill_pedal = true;
  at.step(3);
  at.undo();
  for (int n = 0; n < 50; ++n) {
    at.step();
    ASSERT_EQ(at.tick.gripped, 0);
  }
  ASSERT_FALSE(at.bodies.isSetAside(0));
  at.release(2);
  at.redoAndWait();
  ASSERT_TRUE(at.bodies.isSetAside(0));
  at.undo();
  at.hand.drill_pedal = true;
  at.step(3);
  ASSERT_FALSE(at.bodies.isSetAside(0));
  EXPECT_EQ(at.tick.gripped, 0) << "closed in the tick that brings it";
  at.release(2);
  at.hand.drill_pedal = true;
  at.step();
  EXPECT_EQ(at.tick.gripped, 1);
}

TEST(LuxationStrokes, NothingIsUndoneWhileAPieceIsHeld) {
  Operation at;
  at.cutBone();
  at.forceps();
  at.makeReady();
  at.grip();
  ASSERT_EQ(at.tick.gripped, 1);
  const int strokes = at.tick.strokes;
  const std::uint64_t jaw = at.bodies.jaw().digest();
  at.undo();
  at.step(50);
  at.release(500);
  EXPECT_EQ(at.bodies.jaw().digest(), jaw) << "asked for while it was held";
  EXPECT_EQ(at.tick.strokes, strokes);
  at.undo(2);
  at.step(50);
  EXPECT_NE(at.bodies.jaw().digest(), jaw);
}

TEST(LuxationStrokes, AnUndoOrACutWhileAPieceSettlesEndsTheStroke) {
  for (const bool by_cut : {false, true}) {
    Operation at;
    at.makeReady();
    const std::uint64_t first = at.bodies.digest();
    at.grip();
    at.go({2.0, 0.0, 6.0}, 0.3);
    at.release(by_cut ? 1 : 20);
    ASSERT_NE(at.bodies.digest(), first);
    std::uint64_t ended = at.bodies.digest();
    if (by_cut) {
      // With the bur at once, in the crown.
      at.command.tool = {{ShapeKind::sphere, 0.5, 0.0}, {}, true, false};
      at.hand.X_PT.translation_mm = {0.0, 0.0, 3.6};
      at.step();
      at.hand.drill_pedal = true;
      for (int n = 0; n < 200 && at.tick.removed_mm3 == 0.0; ++n) {
        ended = at.bodies.digest();
        at.step();
      }
      ASSERT_GT(at.tick.removed_mm3, 0.0);
      const PiecePose X_PQ = at.bodies.pose(0);
      at.step(100);
      EXPECT_TRUE(isSame(at.bodies.pose(0), X_PQ));
      at.hand.X_PT.translation_mm = {0.0, 0.0, 8.0};
      at.release();
      at.undo(static_cast<std::uint64_t>(at.tick.strokes - 1));
      at.step(60);
    }
    at.undoAndWait();
    EXPECT_EQ(at.bodies.digest(), first);
    EXPECT_EQ(at.tick.strokes, 0);
    at.redoAndWait();
    if (by_cut) continue;
    EXPECT_EQ(at.bodies.digest(), ended);
    at.step(400);
    EXPECT_EQ(at.bodies.digest(), ended) << "it does not go on";
  }
}

TEST(LuxationStrokes, TheOldestAreDroppedWithEverythingBefore) {
  Operation at;
  at.cutBone();
  ASSERT_EQ(at.tick.strokes, 1);
  at.forceps();
  at.go({2.0, 0.0, 2.0}, 0.1);
  at.makeReady();
  std::vector<std::uint64_t> digests;
  constexpr std::size_t kGrips = LuxationStrokes::kMostKept + 7;
  for (std::size_t n = 0; n < kGrips; ++n) {
    digests.push_back(at.bodies.digest());
    at.hand.drill_pedal = true;
    at.go({2.0, 0.0, n % 2 == 0 ? 3.0 : 1.0}, 0.02);
    ASSERT_EQ(at.tick.gripped, 1) << n;
    at.release(1);
    at.go({2.0, 0.0, 2.0}, 0.02);
    at.step(20);
  }
  digests.push_back(at.bodies.digest());
  EXPECT_EQ(at.tick.strokes, LuxationStrokes::kMostKept);
  at.undo(200);
  at.step(120);
  EXPECT_EQ(at.tick.strokes, 0);
  EXPECT_EQ(at.bodies.digest(), digests[kGrips - LuxationStrokes::kMostKept]);
  at.redo(200);
  at.step(120);
  EXPECT_EQ(at.bodies.digest(), digests.back());
  // Strokes of the bur drop them, too: one at a time, none of those left is touched.
  at.undo(10);
  at.step(20);
  at.cutBone();
  const int strokes = at.tick.strokes;
  EXPECT_EQ(at.tick.undone_strokes, 0);
  at.undo(static_cast<std::uint64_t>(strokes) - LuxationStrokes::kMostKept + 10);
  at.step(60);
  EXPECT_EQ(at.bodies.digest(), digests[kGrips - 10]);
}

/// A hand that grips, cuts, lets go, undoes and redoes at random.
void operate(Operation& at, unsigned seed, int ticks, std::vector<Tick>& seen) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  glm::dvec3 to_mm = at.hand.X_PT.translation_mm;
  for (int n = 0; n < ticks; ++n) {
    if (n % 150 == 0) to_mm = glm::dvec3(2.0, 0.0, 2.5) + 2.5 * glm::dvec3(place(random), place(random), place(random));
    at.hand.X_PT.translation_mm += 0.02 * (to_mm - at.hand.X_PT.translation_mm);
    if (random() % 120 == 0) at.hand.drill_pedal = !at.hand.drill_pedal;
    if (random() % 250 == 0) at.undo(1 + random() % 2);
    if (random() % 250 == 0) at.redo(1 + random() % 2);
    if (random() % 700 == 0) {
      at.command.tool = at.command.tool.grips ? Tool{{ShapeKind::sphere, 0.5, 0.0}, {}, true, false} : forcepsTool();
      ++at.command.serial;
    }
    at.step();
    seen.push_back(at.tick);
  }
}

TEST(LuxationStrokes, RandomUseReplaysBitForBitAndAllocatesNothing) {
  for (const unsigned seed : {3u, 4u, 5u}) {
    std::array<std::vector<Tick>, 2> seen;
    int grips = 0, back = 0;
    for (std::vector<Tick>& ticks : seen) {
      Operation at;
      ticks.reserve(20'000);
      for (int n = 0; n < 6; ++n) {
        at.makeReady();
        const std::size_t before = allocation_count::now();
        operate(at, seed + static_cast<unsigned>(n), 2000, ticks);
        ASSERT_EQ(allocation_count::now(), before);
      }
    }
    for (std::size_t n = 0; n < seen[0].size(); ++n) {
      const Tick &a = seen[0][n], &b = seen[1][n];
      ASSERT_EQ(a.bone_digest, b.bone_digest) << n;
      ASSERT_EQ(std::memcmp(&a.commanded_force_P_N, &b.commanded_force_P_N, sizeof a.commanded_force_P_N), 0);
      ASSERT_EQ(std::memcmp(&a.X_PQ, &b.X_PQ, sizeof a.X_PQ), 0);
      ASSERT_EQ(a.strokes, b.strokes);
      ASSERT_EQ(a.undone_strokes, b.undone_strokes);
      ASSERT_EQ(a.torn_total_Nmm, b.torn_total_Nmm);
      ASSERT_LE(glm::length(a.commanded_force_P_N.xyz), 3.3 * (1.0 + 1e-12));
      grips += n > 0 && a.gripped != 0 && seen[0][n - 1].gripped == 0;
      back += n > 0 && a.gripped == 0 && a.torn_total_Nmm < seen[0][n - 1].torn_total_Nmm;
    }
    EXPECT_GT(grips, 3);
    EXPECT_GT(back, 0);
  }
}

TEST(LuxationStrokes, TakeNoMoreMemoryThanSaid) {
  const Operation at;
  EXPECT_LT(LuxationStrokes(at.bodies).bytes(), 13'000'000u);
  EXPECT_EQ(LuxationStrokes(halfSpace(5.0, 0.5).bodies(1)).bytes(), 0u);
}

}  // namespace
}  // namespace haptics
