#include "haptics/servo/stroke_undo.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "haptics/servo/servo.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Tool;

/// A servo on flat bone and a hand with a commanded position.
struct Room {
  Bodies bone = halfSpace(5.0, 0.2).bodies(1);
  Servo servo{bone};
  Command command;
  HandSample hand;
  double dt_s = 1e-3;
  Tick tick;
  std::vector<Tick> ticks;

  explicit Room(const BurShape& head = {ShapeKind::sphere, 1.0, 0.0}) {
    command.tool.head = head;
    hand.X_PT.translation_mm = {0.0, 0.0, 3.0};
  }

  const Tick& step() {
    tick = servo.step(hand, command, dt_s);
    ticks.push_back(tick);
    return tick;
  }
  void stay(double seconds) {
    for (double left = seconds; left > 0.5 * dt_s; left -= dt_s) step();
  }
  void go(const glm::dvec3& to_mm, double seconds) {
    const glm::dvec3 from = hand.X_PT.translation_mm;
    const int steps = static_cast<int>(seconds / dt_s + 0.5);
    for (int n = 1; n <= steps; ++n) {
      hand.X_PT.translation_mm = glm::mix(from, to_mm, static_cast<double>(n) / steps);
      hand.velocity_P_mm_per_s.xyz = (to_mm - from) / seconds;
      step();
    }
    hand.velocity_P_mm_per_s = {};
  }
  /// Down into the bone next to `x_mm`, along it and out again.
  void cutAt(double x_mm) {
    go({x_mm, -1.5, 1.5}, 0.05);
    hand.drill_pedal = true;
    go({x_mm, -1.5, 0.3}, 0.1);
    go({x_mm, 1.5, 0.2}, 1.6);
    go({x_mm, 1.5, 1.5}, 0.1);
    hand.drill_pedal = false;
    stay(0.35);
  }
  void undo(std::uint64_t strokes = 1) {
    command.undo_serial += strokes;
    ++command.serial;
  }
  void redo(std::uint64_t strokes = 1) {
    command.redo_serial += strokes;
    ++command.serial;
  }
};

std::vector<BlockState> statesOf(const Bodies& bodies) {
  const CarvedBone& bone = bodies.jaw();
  std::vector<BlockState> states;
  for (std::size_t n = 0; n < bone.field().blockAt({0, 0, bone.field().blocks.z}); ++n)
    states.push_back(bone.stateOf(n));
  return states;
}

double newton(const Tick& tick) { return glm::length(tick.commanded_force_P_N.xyz); }

TEST(StrokeUndo, GivesBackWhatAnyHeadCutByAnyLaw) {
  for (const ErosionName& erosion : kErosions)
    for (const BurShape& head : {BurShape{ShapeKind::sphere, 1.0, 0.0}, BurShape{ShapeKind::capsule, 0.8, 1.5},
                                 BurShape{ShapeKind::cylinder, 0.9, 2.0}, BurShape{ShapeKind::cone, 1.0, 2.0}}) {
      Room room(head);
      room.command.erosion.kind = erosion.kind;
      room.cutAt(-1.5);
      const auto before = statesOf(room.bone);
      const std::uint64_t digest = room.bone.digest();
      const auto removed_mm3 = room.bone.removedByTissue_mm3();
      room.cutAt(1.0);
      ASSERT_NE(room.bone.digest(), digest);
      ASSERT_EQ(room.tick.strokes, 2);
      room.undo();
      room.stay(0.3);
      EXPECT_TRUE(statesOf(room.bone) == before);
      EXPECT_EQ(room.tick.bone_digest, digest);
      EXPECT_EQ(room.bone.removedByTissue_mm3(), removed_mm3);
      EXPECT_EQ(room.tick.strokes, 1);
      double net_mm3 = 0.0;
      for (const Tick& tick : room.ticks) net_mm3 += tick.removed_mm3;
      EXPECT_NEAR(net_mm3, removed_mm3[1], 1e-9);
    }
}

TEST(StrokeUndo, GivesBackStrokeAfterStrokeAlsoWhenAskedAtOnce) {
  for (const bool at_once : {false, true}) {
    Room room;
    std::vector<std::uint64_t> digests;
    for (const double x_mm : {-2.0, -0.5, 0.5, 2.0}) {
      digests.push_back(room.bone.digest());
      room.cutAt(x_mm);
    }
    if (at_once) {
      room.undo(3);
      room.stay(0.3);
    } else {
      for (std::size_t n = 3; n > 0; --n) {
        room.undo();
        room.stay(0.2);
        EXPECT_EQ(room.bone.digest(), digests[n]);
      }
    }
    EXPECT_EQ(room.bone.digest(), digests[1]);
    room.undo(1'000'000);
    room.stay(0.2);
    EXPECT_EQ(room.bone.digest(), digests[0]);
    EXPECT_EQ(room.tick.strokes, 0);
  }
}

TEST(StrokeUndo, ChangesNothingWhereThereIsNothingToTakeBack) {
  Room room, other;
  for (Room* one : {&room, &other}) {
    one->go({0.0, 0.0, 0.8}, 0.2);
    ++one->command.serial;
  }
  room.command.undo_serial = 5;
  for (Room* one : {&room, &other}) {
    one->hand.drill_pedal = true;
    one->stay(0.2);
    EXPECT_TRUE(one->tick.drilling);
    EXPECT_EQ(one->tick.drill_inhibit, DrillInhibit::none);
  }
  EXPECT_EQ(room.bone.digest(), other.bone.digest());
  EXPECT_EQ(room.tick.commanded_force_P_N.xyz, other.tick.commanded_force_P_N.xyz);
  // A request that could not be served is dropped; a smaller serial is no request.
  const std::uint64_t cut = room.bone.digest();
  room.command.undo_serial = 2;
  room.hand.drill_pedal = false;
  room.stay(0.5);
  EXPECT_EQ(room.bone.digest(), cut);
  EXPECT_EQ(room.tick.strokes, 1);
}

TEST(StrokeUndo, ParsesStrokesByPausesOfThreeTenthsOfASecondAtAnyRate) {
  for (const double rate_Hz : {500.0, 1000.0, 4000.0})
    for (const auto& [pause_s, strokes] : {std::pair(0.28, 1), std::pair(0.31, 2)})
      for (const bool lifts_foot : {true, false}) {
        Room room;
        room.dt_s = 1.0 / rate_Hz;
        room.hand.drill_pedal = true;
        room.go({0.0, 0.0, 0.2}, 0.2);
        // Off the pedal with the bur in bone, or off the bone with the foot down.
        if (lifts_foot) {
          room.hand.drill_pedal = false;
        } else {
          room.hand.X_PT.translation_mm.z = 2.0;
        }
        room.stay(pause_s);
        room.hand.drill_pedal = true;
        room.hand.X_PT.translation_mm = {1.0, 0.0, 0.2};
        room.stay(0.2);
        EXPECT_EQ(room.tick.strokes, strokes) << rate_Hz << " Hz, " << pause_s << " s, foot " << lifts_foot;
      }
}

TEST(StrokeUndo, StopsTheDrillUntilTheFootHasLeftThePedal) {
  Room room;
  const std::uint64_t whole = room.bone.digest();
  room.go({0.0, 0.0, 1.2}, 0.05);
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, -0.5}, 0.5);
  ASSERT_NE(room.bone.digest(), whole);
  room.undo();
  room.stay(0.3);
  EXPECT_EQ(room.bone.digest(), whole);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::tool_embedded);
  room.go({0.0, 0.0, 2.0}, 0.2);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::pedal_held);
  EXPECT_FALSE(room.tick.drilling);
  // The pedal state of a tick with an invalid pose is ignored.
  const double x_mm = room.hand.X_PT.translation_mm.x;
  room.hand.X_PT.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
  room.step();
  room.hand.X_PT.translation_mm.x = x_mm;
  room.stay(0.1);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::pedal_held);
  room.hand.drill_pedal = false;
  room.step();
  room.hand.drill_pedal = true;
  room.step();
  EXPECT_TRUE(room.tick.drilling);
  room.go({0.0, 0.0, 0.5}, 0.3);
  EXPECT_NE(room.bone.digest(), whole);
}

TEST(StrokeUndo, PressingThePedalInsideReturnedBoneCutsNothing) {
  Room room;
  const std::uint64_t whole = room.bone.digest();
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, -0.5}, 0.8);
  room.hand.drill_pedal = false;
  room.stay(0.01);
  room.undo();
  room.stay(0.2);
  room.hand.drill_pedal = true;
  room.stay(0.2);
  room.go({0.0, 0.0, 3.0}, 0.5);
  EXPECT_EQ(room.bone.digest(), whole);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::pedal_held);
}

TEST(StrokeUndo, StopsTheDrillInTheAirTooWhenAllComesBackAtOnce) {
  Room room;
  const std::uint64_t whole = room.bone.digest();
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, 0.9}, 0.1);
  room.go({0.0, 0.0, 2.5}, 0.1);
  ASSERT_TRUE(room.tick.drilling);
  room.undo();
  room.step();
  EXPECT_EQ(room.bone.digest(), whole);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::pedal_held);
  EXPECT_FALSE(room.tick.drilling);
}

TEST(StrokeUndo, NeverThrowsAHandInsideTheReturningBone) {
  for (const double rate_Hz : {1000.0, 2000.0})
    for (const auto& [pressing, late] : {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
      Room room;
      room.dt_s = 1.0 / rate_Hz;
      room.command.tool.shaft = {0.6, 12.0};
      room.hand.drill_pedal = true;
      room.go({0.0, 0.0, -1.5}, 1.5);
      // On the floor of its own pit, with the foot off, resting or pressing on; the pit may be what comes back last.
      const double floor_mm = room.tick.proxy_P.mm.z;
      if (late) {
        room.go({2.5, 0.0, 0.0}, 0.3);
        room.go({2.5, 3.0, -1.0}, 0.3);
        room.go({-2.5, 3.0, -1.0}, 0.5);
        room.go({-2.5, 3.0, 2.0}, 0.2);
      }
      room.hand.drill_pedal = false;
      if (late) {
        room.go({0.0, 0.0, 2.0}, 0.05);
        room.go({0.0, 0.0, floor_mm}, 0.1);
      }
      room.go({0.0, 0.0, room.tick.proxy_P.mm.z - (pressing ? 1.0 : 0.0)}, 0.2);
      room.stay(0.1);
      const double before_N = newton(room.tick);
      if (pressing) {
        ASSERT_GT(before_N, 0.4);
      }
      ASSERT_LT(room.tick.proxy_P.mm.z, -0.5);
      room.undo(50);
      const std::size_t from = room.ticks.size();
      room.step();
      EXPECT_EQ(room.tick.drill_inhibit, late ? DrillInhibit::undo_running : DrillInhibit::tool_embedded);
      room.stay(0.1);
      EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::tool_embedded);
      EXPECT_EQ(newton(room.tick), 0.0);
      room.go({0.3, 0.0, -0.5}, 0.1);
      room.go({0.0, 0.0, 3.0}, 0.3);
      EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::none);
      for (std::size_t n = from; n < room.ticks.size(); ++n) {
        // Never more than there was, and as smooth as a switch: 1.5 difference / 40 ms.
        EXPECT_LE(newton(room.ticks[n]), before_N + 1e-9);
        EXPECT_LE(glm::length(room.ticks[n].commanded_force_P_N.xyz - room.ticks[n - 1].commanded_force_P_N.xyz),
                  1.01 * 1.5 * before_N / 0.04 * room.dt_s + 1e-9);
      }
      // Once out of the bone, contact is normal again.
      room.go({0.0, 0.0, 0.8}, 0.2);
      EXPECT_NEAR(newton(room.tick), 0.16, 0.01);
    }
}

TEST(StrokeUndo, IsNotFeltByAToolElsewhere) {
  Room room, other;
  for (Room* one : {&room, &other}) {
    one->cutAt(-3.0);
    one->go({2.0, 0.0, 0.5}, 0.3);
    one->stay(0.1);
    ++one->command.serial;
  }
  ++room.command.undo_serial;
  for (int n = 0; n < 500; ++n) {
    for (Room* one : {&room, &other}) {
      one->hand.X_PT.translation_mm.x = 2.0 + 0.5 * std::sin(0.02 * n);
      one->step();
    }
    ASSERT_EQ(room.tick.commanded_force_P_N.xyz, other.tick.commanded_force_P_N.xyz);
    ASSERT_EQ(room.tick.proxy_P.mm, other.tick.proxy_P.mm);
  }
  EXPECT_GT(newton(room.tick), 0.3);
  EXPECT_NE(room.bone.digest(), other.bone.digest());
}

TEST(StrokeUndo, LeavesBoneThatFeelsLikeBoneNeverCut) {
  for (const LawName& law : kLaws) {
    Room room, never;
    for (Room* one : {&room, &never}) one->command.law.kind = law.kind;
    room.cutAt(0.0);
    room.undo();
    room.stay(0.4);
    for (int n = 0; n < 50 && room.tick.spindle_rad_per_s != 0.0; ++n) room.stay(0.1);
    never.go(room.hand.X_PT.translation_mm, 0.1);
    for (Room* one : {&room, &never}) {
      one->go({0.0, -1.0, 1.4}, 0.2);
      one->ticks.clear();
      one->go({0.0, -1.0, 0.4}, 0.1);
      one->go({0.3, 1.0, -0.2}, 0.2);
    }
    ASSERT_EQ(room.ticks.size(), never.ticks.size());
    for (std::size_t n = 0; n < room.ticks.size(); ++n) {
      ASSERT_EQ(room.ticks[n].law_force_P_N.xyz, never.ticks[n].law_force_P_N.xyz) << law.key;
      ASSERT_EQ(room.ticks[n].commanded_force_P_N.xyz, never.ticks[n].commanded_force_P_N.xyz) << law.key;
    }
  }
}

TEST(StrokeUndo, GivesBackNoMoreThanSixtyFourBlocksInATick) {
  Room room({ShapeKind::sphere, 3.0, 0.0});
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, 0.0}, 0.5);
  room.hand.drill_pedal = false;
  room.go({0.0, 0.0, 4.0}, 0.2);
  room.undo(50);
  int undoing = 0;
  auto before = statesOf(room.bone);
  do {
    room.step();
    const auto now = statesOf(room.bone);
    std::size_t changed = 0;
    for (std::size_t n = 0; n < now.size(); ++n) changed += now[n] == before[n] ? 0 : 1;
    ASSERT_LE(changed, StrokeUndo::kBlocksPerTick);
    before = now;
    ++undoing;
  } while (room.tick.drill_inhibit == DrillInhibit::undo_running);
  EXPECT_GT(undoing, 3);
  EXPECT_EQ(room.tick.strokes, 0);
}

TEST(StrokeUndo, RedoesWhatWasUndoneAndTellsHowMuch) {
  Room room;
  std::vector<std::uint64_t> digests{room.bone.digest()};
  for (const double x_mm : {-2.0, 0.0, 2.0}) {
    room.cutAt(x_mm);
    digests.push_back(room.bone.digest());
  }
  const auto strokes = static_cast<std::size_t>(room.tick.strokes);
  ASSERT_EQ(strokes, 3u);
  const double cut_mm3 = room.tick.removed_total_mm3[1];
  room.undo(2);
  room.stay(0.2);
  EXPECT_EQ(room.bone.digest(), digests[1]);
  EXPECT_EQ(room.tick.undone_strokes, 2);
  EXPECT_NEAR(room.tick.restored_total_mm3, cut_mm3 - room.tick.removed_total_mm3[1], 1e-9);
  room.redo();
  room.stay(0.2);
  EXPECT_EQ(room.bone.digest(), digests[2]);
  EXPECT_EQ(room.tick.strokes, 2);
  EXPECT_EQ(room.tick.undone_strokes, 1);
  room.redo(100);
  room.stay(0.2);
  EXPECT_EQ(room.bone.digest(), digests[3]);
  EXPECT_NEAR(room.tick.restored_total_mm3, 0.0, 1e-9);
  // What was asked for in vain is not owed, and one of each cancels out.
  room.undo();
  room.redo();
  room.stay(0.2);
  EXPECT_EQ(room.bone.digest(), digests[3]);
  room.cutAt(1.0);
  room.redo();
  const std::uint64_t cut = room.bone.digest();
  room.stay(0.2);
  EXPECT_EQ(room.bone.digest(), cut);
}

TEST(StrokeUndo, TurnsBackWithinAStroke) {
  Room room({ShapeKind::sphere, 3.0, 0.0});
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, 0.8}, 0.5);
  room.hand.drill_pedal = false;
  room.go({0.0, 0.0, 4.0}, 0.2);
  const std::uint64_t cut = room.bone.digest();
  room.undo();
  room.step();
  ASSERT_EQ(room.tick.drill_inhibit, DrillInhibit::undo_running);
  room.redo();
  room.stay(0.1);
  EXPECT_EQ(room.bone.digest(), cut);
  EXPECT_EQ(room.tick.undone_strokes, 0);
  EXPECT_EQ(room.tick.drill_inhibit, DrillInhibit::none);
}

/// Strokes of a bur that moves as told, without servo. Removes `mm3_per_s`.
int strokesOf(const std::vector<std::pair<glm::dvec3, double>>& way, double mm3_per_s, double dt_s) {
  StrokeExtent extent;
  int ends = 0;
  glm::dvec3 at_mm(0.0);
  for (const auto& [to_mm, seconds] : way) {
    const int steps = static_cast<int>(seconds / dt_s + 0.5);
    const glm::dvec3 from_mm = at_mm;
    for (int n = 1; n <= steps; ++n) {
      at_mm = glm::mix(from_mm, to_mm, static_cast<double>(n) / steps);
      ends += extent.endsAt(true, {at_mm}, mm3_per_s * dt_s, dt_s) ? 1 : 0;
    }
  }
  return ends;
}

TEST(StrokeExtent, EndsAtAReversalOfOneMillimetreThreeSecondsOrFiveCubicMillimetres) {
  for (const double dt_s : {2e-3, 1e-3, 2.5e-4}) {
    // One way, 2.9 s: none. Ten seconds on the spot: three.
    EXPECT_EQ(strokesOf({{{6.0, 0.0, 0.0}, 2.9}}, 0.5, dt_s), 0);
    EXPECT_EQ(strokesOf({{{0.0, 0.0, 0.0}, 10.0}}, 0.5, dt_s), 3);
    // 4 mm³/s for 4 s: three times five.
    EXPECT_EQ(strokesOf({{{0.0, 0.0, 0.0}, 3.99}}, 4.0, dt_s), 3);
    // To and fro by 2 mm ends each pass, a tremor of 0.9 mm ends nothing.
    const std::pair<glm::dvec3, double> out{{2.0, 0.0, 0.0}, 0.5}, home{{0.0, 0.0, 0.0}, 0.5};
    EXPECT_EQ(strokesOf({out, home, out, home}, 0.5, dt_s), 3);
    const std::pair<glm::dvec3, double> near{{0.9, 0.0, 0.0}, 0.3}, back{{0.0, 0.0, 0.0}, 0.3};
    EXPECT_EQ(strokesOf({near, back, near, back}, 0.5, dt_s), 0);
  }
}

TEST(StrokeExtent, WhatRemovesHardlyAnythingGoesOnWithTheNext) {
  for (const double dt_s : {2e-3, 1e-3, 2.5e-4}) {
    // 0.01 mm³ a pass: five of them are one.
    const std::pair<glm::dvec3, double> out{{2.0, 0.0, 0.0}, 0.5}, home{{0.0, 0.0, 0.0}, 0.5};
    EXPECT_EQ(strokesOf({out, home, out, home, out}, 0.02, dt_s), 0);
    EXPECT_EQ(strokesOf({out, home, out, home, out, home, out}, 0.02, dt_s), 1);
    // A touch, a pause, and a touch again.
    StrokeExtent extent;
    const auto touch = [&](double removed_mm3) {
      int ends = extent.endsAt(true, {glm::dvec3(0.0)}, removed_mm3, dt_s) ? 1 : 0;
      for (int n = 0; n < static_cast<int>(0.5 / dt_s); ++n)
        ends += extent.endsAt(false, {glm::dvec3(0.0)}, 0.0, dt_s) ? 1 : 0;
      return ends;
    };
    EXPECT_EQ(touch(0.03), 0);
    EXPECT_EQ(touch(0.03), 1);
    EXPECT_EQ(touch(0.03), 0);
  }
}

TEST(StrokeUndo, ATroughOnOnePedalIsManyStrokes) {
  Room room;
  room.go({-2.0, 0.0, 1.2}, 0.1);
  room.hand.drill_pedal = true;
  for (int pass = 0; pass < 8; ++pass) room.go({pass % 2 == 0 ? 2.0 : -2.0, 0.0, 0.9 - 0.1 * pass}, 1.0);
  EXPECT_GE(room.tick.strokes, 7) << "one for each pass";
  const double cut_mm3 = room.tick.removed_total_mm3[1];
  room.hand.drill_pedal = false;
  room.go({0.0, 0.0, 4.0}, 0.3);
  room.undo();
  room.stay(0.3);
  EXPECT_GT(room.tick.restored_total_mm3, 0.0);
  EXPECT_LE(room.tick.restored_total_mm3, StrokeExtent::kLargest_mm3 + 0.1);
  EXPECT_LT(room.tick.restored_total_mm3, 0.4 * cut_mm3);
}

/// Random input of hand and instructor: drills, leaves, undoes, jumps.
void wander(Room& room, unsigned seed, int steps) {
  std::mt19937 random(seed);
  std::normal_distribution<double> move(0.0, 0.04);
  for (int n = 0; n < steps; ++n) {
    const glm::dvec3 way(move(random), move(random), move(random));
    room.hand.X_PT.translation_mm =
        glm::clamp(room.hand.X_PT.translation_mm + way, {-4.0, -4.0, -1.0}, {4.0, 4.0, 2.0});
    if (random() % 100 == 0) room.hand.X_PT.translation_mm.z = 1.2;
    if (random() % 100 == 0) room.hand.drill_pedal = !room.hand.drill_pedal;
    if (random() % 150 == 0) room.undo(1 + random() % 3);
    if (random() % 200 == 0) room.redo(1 + random() % 2);
    room.step();
  }
}

TEST(StrokeUndo, ReplaysBitForBit) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    Room room, again;
    wander(room, seed, 4000);
    wander(again, seed, 4000);
    int returned = 0;
    for (std::size_t n = 0; n < room.ticks.size(); ++n) {
      const Tick &a = room.ticks[n], &b = again.ticks[n];
      ASSERT_EQ(std::memcmp(&a.commanded_force_P_N, &b.commanded_force_P_N, sizeof a.commanded_force_P_N), 0);
      ASSERT_EQ(std::memcmp(&a.proxy_P, &b.proxy_P, sizeof a.proxy_P), 0);
      ASSERT_EQ(a.bone_digest, b.bone_digest);
      ASSERT_EQ(a.removed_mm3, b.removed_mm3);
      ASSERT_EQ(a.drill_inhibit, b.drill_inhibit);
      ASSERT_EQ(a.strokes, b.strokes);
      ASSERT_EQ(a.undone_strokes, b.undone_strokes);
      ASSERT_EQ(a.restored_total_mm3, b.restored_total_mm3);
      returned += a.removed_mm3 < 0.0 ? 1 : 0;
    }
    EXPECT_GE(returned, 3);
  }
}

TEST(StrokeUndo, KeepsEveryLimitInSenselessUse) {
  for (unsigned seed = 10; seed < 14; ++seed) {
    Room room;
    wander(room, seed, 3000);
    double removed_mm3 = 0.0;
    glm::dvec3 last_N(0.0);
    for (const Tick& tick : room.ticks) {
      removed_mm3 += tick.removed_mm3;
      ASSERT_LE(newton(tick), 3.3 * (1.0 + 1e-12));
      ASSERT_LE(glm::length(tick.commanded_force_P_N.xyz - last_N), 0.3 * (1.0 + 1e-12));
      last_N = tick.commanded_force_P_N.xyz;
    }
    EXPECT_NEAR(removed_mm3, room.bone.removedByTissue_mm3()[1], 1e-9);
  }
}

TEST(StrokeUndo, AllocatesNothing) {
  Room room;
  room.ticks.reserve(5000);
  const std::size_t before = allocation_count::now();
  wander(room, 21, 4000);
  EXPECT_EQ(allocation_count::now(), before);
}

}  // namespace
}  // namespace haptics
