// Material laid, pressed, carved and cured in cavities whose volume is a formula.
#include "haptics/bone/filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "haptics/bone/carve.h"
#include "haptics/bone/cure.h"
#include "haptics/bone/lay.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using assets::Tissue;

constexpr double kVoxel_mm = 0.08, kPi = 3.14159265358979;
constexpr std::int64_t kAll = 1'000'000'000;

/// Solid but for a cylinder along z, D 2 mm, from `low_mm` to `high_mm`.
Phantom drilled(double low_mm = -1.0, double high_mm = 1.0) {
  return filled(2.4, kVoxel_mm, [=](const glm::dvec3& p) {
    const double beside = std::hypot(p.x, p.y) - 1.0, over = std::max(p.z - high_mm, low_mm - p.z);
    return -std::max(beside, over);  // solid where it is negative
  });
}

struct Cavity {
  Bodies bodies;
  StrokeHistory strokes{bodies.bones(), StrokeHistory::kMaxBlocks, bodies.filling()};
  std::uint64_t tick = 0;

  explicit Cavity(const Phantom& of) : bodies(of.bodies(static_cast<std::uint8_t>(Tissue::dentine))) {}
  Filling& filling() { return *bodies.filling(); }
  LaidBall ball(const glm::dvec3& at_mm, double radius_mm = 0.5) {
    return {bodies.jaw().field(), filling(), {at_mm}, radius_mm, tick++, &strokes};
  }
  /// A ball all over the cavity, so that no air is left up to `high_mm`.
  void fill(double high_mm = 1.2, Tissue with = Tissue::composite_soft) {
    for (double z = -1.2; z <= high_mm - 0.5 + 1e-9; z += 0.2)
      for (double y = -1.2; y <= 1.21; y += 0.3)
        for (double x = -1.2; x <= 1.21; x += 0.3) layBall(ball({x, y, z}), with, 1, kAll);
  }
};

double mm3(std::int64_t steps) { return static_cast<double>(steps) * kVoxel_mm * kVoxel_mm * kVoxel_mm / 255.0; }

TEST(Filling, OfACylinderHasItsVolume) {
  Cavity cavity(drilled());
  cavity.fill(1.8);
  EXPECT_NEAR(cavity.filling().volume_mm3(), 2.0 * kPi, 0.01 * 2.0 * kPi);
  // Nothing is laid where there is tooth.
  const SolidField tooth = cavity.bodies.jaw().field(), laid = cavity.filling().field();
  assets::forVoxels(cavity.bodies.grid(),
                    [&](glm::ivec3 ijk, std::size_t) { ASSERT_LE(tooth.solidAt(ijk) + laid.solidAt(ijk), 255); });
  EXPECT_NEAR(cavity.filling().volume_mm3(Tissue::composite_soft), cavity.filling().volume_mm3(), 1e-9);
}

TEST(Filling, IsLaidAtItsRateAndOnlyWhereTheBallTouches) {
  Cavity cavity(drilled(-1.0, 3.0));
  EXPECT_EQ(layBall(cavity.ball({0.0, 0.0, 0.0}), Tissue::composite_soft, 1, 500), 0);  // amid air
  for (int n = 0; n < 40; ++n) EXPECT_EQ(layBall(cavity.ball({0.0, 0.0, -0.6}), Tissue::composite_soft, 1, 500), 500);
  EXPECT_NEAR(cavity.filling().volume_mm3(), mm3(40 * 500), 1e-12);
  EXPECT_EQ(layBall(cavity.ball({0.0, 0.0, NAN}), Tissue::composite_soft, 1, 500), 0);
}

TEST(Filling, ComesBackByUndoToTheBit) {
  Cavity cavity(drilled());
  const std::uint64_t empty = cavity.bodies.digest();
  cavity.fill(0.6);
  cavity.strokes.endStroke();
  const std::uint64_t half = cavity.bodies.digest();
  const double half_mm3 = cavity.filling().volume_mm3();
  cavity.fill(1.8);
  cavity.strokes.endStroke();
  const std::uint64_t full = cavity.bodies.digest();
  EXPECT_NE(half, full);
  const auto undo = [&] { cavity.strokes.undo(cavity.bodies.bones(), 100'000, cavity.bodies.filling()); };
  const auto redo = [&] { cavity.strokes.redo(cavity.bodies.bones(), 100'000, cavity.bodies.filling()); };
  undo();
  EXPECT_EQ(cavity.bodies.digest(), half);
  EXPECT_NEAR(cavity.filling().volume_mm3(), half_mm3, 1e-12);
  undo();
  EXPECT_EQ(cavity.bodies.digest(), empty);
  EXPECT_TRUE(cavity.filling().isEmpty());
  redo(), redo();
  EXPECT_EQ(cavity.bodies.digest(), full);
}

TEST(Filling, IsPressedAsideWithoutLoss) {
  Cavity cavity(drilled(-1.0, 3.0));
  cavity.fill(0.9);
  const double before_mm3 = cavity.filling().volume_mm3();
  std::int64_t moved = 0;
  for (int n = 0; n < 200; ++n) moved += packBall(cavity.ball({0.3, 0.0, 0.9 - 0.002 * n}, 0.7), 0.2);
  EXPECT_GT(mm3(moved), 0.1);
  EXPECT_NEAR(cavity.filling().volume_mm3(), before_mm3, 1e-12);
  // Nothing of it is left where the ball was, but in part voxels.
  const SolidField laid = cavity.filling().field();
  assets::forVoxels(cavity.bodies.grid(), [&](glm::ivec3 ijk, std::size_t) {
    const double from_mm = glm::distance(laid.grid.centre_P_mm(ijk), glm::dvec3(0.3, 0.0, 0.5));
    if (from_mm < 0.4) {
      ASSERT_LT(laid.solidAt(ijk), 20);
    }
  });
}

TEST(Filling, SetsToTwoMillimetresUnderTheLampAndNoDeeper) {
  Cavity cavity(drilled(-2.0, 2.3));
  for (double z = -1.6; z <= 1.0; z += 0.2)
    for (double y = -0.9; y <= 0.91; y += 0.3)
      for (double x = -0.9; x <= 0.91; x += 0.3) layBall(cavity.ball({x, y, z}), Tissue::composite_soft, 1, kAll);
  const double all_mm3 = cavity.filling().volume_mm3();
  CuringLight light;
  double set_mm3 = 0.0;
  const auto shine = [&](double seconds) {
    for (int n = 0; n < static_cast<int>(seconds * 1000.0); ++n)
      set_mm3 += mm3(light.shine(cavity.bodies.jaw().field(), cavity.filling(), {{1, 0, 0, 0}, {0, 0, 5.0}}, 3.0, 1e-3,
                                 &cavity.strokes));
  };
  shine(8.0);
  EXPECT_EQ(cavity.filling().volume_mm3(Tissue::composite), 0.0);
  shine(6.0);
  EXPECT_NEAR(cavity.filling().volume_mm3(Tissue::composite), set_mm3, 1e-9);
  EXPECT_NEAR(cavity.filling().volume_mm3(), all_mm3, 1e-12);
  // The top lies at 1.5, so light ends 2 mm below; a march of 0.16 mm blurs it.
  const SolidField laid = cavity.filling().field();
  for (double z = -1.7; z < 1.3; z += 0.08) {
    const glm::ivec3 ijk(glm::floor(laid.grid.indexFromPoint({0.0, 0.0, z}) + 0.5));
    const bool is_lit = laid.labelAt(ijk) == static_cast<std::uint8_t>(Tissue::composite);
    EXPECT_TRUE(std::abs(z + 0.5) < 0.2 || is_lit == (z > -0.5)) << z;
  }
}

/// Of a ball of filling in a cavity, mm3 that a carver takes in half a second; `with` laid.
double carved(Tissue with) {
  Cavity cavity(drilled());
  cavity.fill(1.8, with);
  ErosionStep step;
  step.loss[static_cast<std::size_t>(with)] =
      kCarving_per_s * assets::properties(static_cast<std::uint8_t>(with)).removal_factor * 1e-3;
  const double before_mm3 = cavity.filling().volume_mm3();
  double taken_mm3 = 0.0;
  for (std::uint64_t n = 0; n < 500; ++n)
    taken_mm3 += carveTool(cavity.filling(), {ShapeKind::sphere, 0.4, 0.0}, {{1, 0, 0, 0}, {0, 0, 0}}, step, n, 1,
                           &cavity.strokes)
                     .removed_mm3;
  EXPECT_NEAR(before_mm3 - cavity.filling().volume_mm3(), taken_mm3, 1e-9);
  return taken_mm3;
}

TEST(Filling, IsCarvedByHowHardItIs) {
  const double ball_mm3 = 4.0 / 3.0 * kPi * 0.4 * 0.4 * 0.4;
  EXPECT_NEAR(carved(Tissue::composite_soft), ball_mm3, 0.01 * ball_mm3);  // all of it, and no more
  EXPECT_NEAR(carved(Tissue::composite), 0.5 * 1.25 * kCarving_per_s * ball_mm3, 0.03 * ball_mm3);
}

/// A servo on such a cavity and a hand that presses its button.
struct Room {
  Bodies bodies = drilled(-1.0, 3.0).bodies(static_cast<std::uint8_t>(Tissue::dentine));
  Servo servo{bodies};
  Command command;
  HandSample hand;
  Tick tick;
  std::vector<Tick> ticks;

  Room() {
    command.tool = handInstrumentTool(HandInstrument::composite);
    hand.X_PT.translation_mm = {0.0, 0.0, 2.0};
  }
  void go(const glm::dvec3& to_mm, int steps) {
    const glm::dvec3 from = hand.X_PT.translation_mm;
    for (int n = 1; n <= steps; ++n) {
      hand.X_PT.translation_mm = glm::mix(from, to_mm, static_cast<double>(n) / steps);
      tick = servo.step(hand, command, 1e-3);
      ticks.push_back(tick);
    }
  }
  void stroke() {
    go({0.0, 0.0, -0.5}, 200);
    hand.drill_pedal = true;
    go({0.3, 0.0, -0.3}, 300);
    hand.drill_pedal = false;
    go({0.0, 0.0, 2.0}, 500);
  }
};

TEST(Filling, IsLaidByTheServoWithoutAllocating) {
  Room room;
  room.go({0.0, 0.0, -0.5}, 200);
  room.ticks.reserve(10'000);
  room.hand.drill_pedal = true;
  const std::size_t before = allocation_count::now();
  room.go({0.3, 0.0, -0.3}, 300);
  EXPECT_EQ(allocation_count::now(), before);
  EXPECT_NEAR(room.tick.filling.total_mm3, 0.3 * kLaying_mm3_per_s, 0.1 * kLaying_mm3_per_s);
  EXPECT_EQ(room.tick.filling.increment, 1);
  // Neither is it tooth that was removed, nor does undo count it so.
  EXPECT_EQ(room.tick.removed_total_mm3, (std::array<double, assets::kTissueCount>{}));
}

TEST(Filling, IsUndoneByTheServoAPressAtATime) {
  Room room;
  room.stroke();
  const std::uint64_t one = room.tick.bone_digest;
  const std::uint8_t strokes = room.tick.strokes;
  room.go({0.0, 0.0, 2.0}, 400);
  room.stroke();
  EXPECT_EQ(room.tick.strokes, strokes + 1);
  EXPECT_NE(room.tick.bone_digest, one);
  room.command.undo_serial = 1;
  room.go({0.0, 0.0, 2.0}, 100);
  EXPECT_EQ(room.tick.bone_digest, one);
  EXPECT_EQ(room.tick.removed_mm3, 0.0);
  room.command.undo_serial = 2;
  room.go({0.0, 0.0, 2.0}, 100);
  EXPECT_EQ(room.tick.filling.total_mm3, 0.0);
  EXPECT_EQ(room.tick.bone_digest, room.ticks.front().bone_digest);
}

TEST(Filling, OfAnotherMaterialIsAnotherIncrement) {
  Room room;
  room.stroke();
  EXPECT_EQ(room.tick.filling.increment, 1);
  room.stroke();
  EXPECT_EQ(room.tick.filling.increment, 1);
  // Where there is air still.
  room.command.tool = handInstrumentTool(HandInstrument::glass_ionomer);
  room.go({-0.7, 0.0, 0.6}, 200);
  room.hand.drill_pedal = true;
  room.go({-0.7, 0.0, 0.9}, 200);
  EXPECT_EQ(room.tick.filling.increment, 2);
  EXPECT_GT(room.bodies.filling()->volume_mm3(Tissue::glass_ionomer_soft), 0.1);
}

TEST(Filling, IsTheSameBitsAgain) {
  Room first, second;
  for (Room* room : {&first, &second}) {
    room->stroke();
    room->command.tool = handInstrumentTool(HandInstrument::plugger);
    room->stroke();
    room->command.tool = handInstrumentTool(HandInstrument::carver);
    room->stroke();
  }
  for (std::size_t n = 0; n < first.ticks.size(); ++n) {
    ASSERT_EQ(first.ticks[n].bone_digest, second.ticks[n].bone_digest) << n;
    ASSERT_EQ(first.ticks[n].law_force_P_N.xyz, second.ticks[n].law_force_P_N.xyz) << n;
  }
  EXPECT_GT(first.tick.filling.total_mm3, 0.0);
}

/// The same tooth with what was laid into it, as another servo finds it.
Bodies goneOnWith(const Bodies& of, std::vector<double> age_s = {}) {
  Bodies next = drilled(-1.0, 3.0).bodies(static_cast<std::uint8_t>(Tissue::dentine));
  Filling::Volumes laid = of.filling()->volumes();
  laid.age_s = std::move(age_s);
  next.filling()->begin(laid);
  return next;
}

TEST(Filling, GoesOnWithEveryByteOfIt) {
  Room room;
  room.stroke();
  const glm::dvec3 over{0.0, 0.0, 2.0};
  room.command.tool = handInstrumentTool(HandInstrument::curing_lamp);
  room.go(over, 100);
  room.hand.drill_pedal = true;
  room.go(over, 6000);  // not enough to set
  ASSERT_EQ(room.bodies.filling()->volume_mm3(Tissue::composite), 0.0);
  Bodies next = goneOnWith(room.bodies);
  EXPECT_EQ(next.digest(), room.bodies.digest());
  EXPECT_FALSE(next.filling()->volumes().light.empty());
  // The light that it had counts.
  Servo servo(next);
  HandSample hand = room.hand;
  hand.drill_pedal = false;
  Tick tick = servo.step(hand, room.command, 1e-3);
  EXPECT_EQ(tick.bone_digest, room.tick.bone_digest);
  EXPECT_EQ(tick.strokes, 0) << "what was done before is not undone";
  hand.drill_pedal = true;
  for (int n = 0; n < 6000; ++n) tick = servo.step(hand, room.command, 1e-3);
  EXPECT_GT(tick.filling.cured_mm3, 0.3 * tick.filling.total_mm3);
  Command undo = room.command;
  undo.undo_serial = 5;
  hand.drill_pedal = false;
  for (int n = 0; n < 300; ++n) tick = servo.step(hand, undo, 1e-3);
  EXPECT_EQ(tick.bone_digest, room.tick.bone_digest);
}

TEST(Filling, GoesOnWithItsIncrementUntilSomeOfItHasSet) {
  Room room;
  room.stroke();
  const auto nextIncrement = [&](HandInstrument with) {
    Room next;
    next.bodies = goneOnWith(room.bodies);
    Servo servo(next.bodies);
    next.command.tool = handInstrumentTool(with);
    next.hand.X_PT.translation_mm = {-0.7, 0.0, 0.6};
    for (int n = 0; n < 400; ++n) {
      next.hand.drill_pedal = n > 100;
      next.tick = servo.step(next.hand, next.command, 1e-3);
    }
    EXPECT_GT(next.tick.filling.total_mm3, room.tick.filling.total_mm3);
    return next.tick.filling.increment;
  };
  EXPECT_EQ(nextIncrement(HandInstrument::composite), 1);
  EXPECT_EQ(nextIncrement(HandInstrument::amalgam), 2);
  room.command.tool = handInstrumentTool(HandInstrument::curing_lamp);
  room.go({0.0, 0.0, 2.0}, 100);
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, 2.0}, 12000);
  ASSERT_GT(room.tick.filling.cured_mm3, 0.0);
  EXPECT_EQ(nextIncrement(HandInstrument::composite), 2);
}

TEST(Filling, BeginsOfAStrangersBytesWithoutHarm) {
  std::mt19937 random(7);
  Bodies bodies = drilled().bodies(static_cast<std::uint8_t>(Tissue::dentine));
  const std::size_t count = bodies.grid().voxelCount();
  Filling::Volumes laid{std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count),
                        std::vector<std::uint8_t>(count), std::vector<std::uint16_t>(count),
                        std::vector<double>(300, 1e8)};
  for (std::size_t v = 0; v < count; ++v) {
    laid.laid[v] = static_cast<std::uint8_t>(random());
    laid.tissue[v] = static_cast<std::uint8_t>(random() % assets::kTissueCount);
    laid.increment[v] = static_cast<std::uint8_t>(random());
    laid.light[v] = static_cast<std::uint16_t>(random());
  }
  bodies.filling()->begin(laid);
  const Filling::Volumes kept = bodies.filling()->volumes();
  EXPECT_LE(*std::ranges::max_element(kept.increment), Filling::kMostIncrements);
  EXPECT_LE(*std::ranges::max_element(kept.light), Filling::kMostLight);
  EXPECT_LE(bodies.filling()->begun().increment, Filling::kMostIncrements);
  Servo servo(bodies);
  HandSample hand;
  hand.drill_pedal = true;
  Command command;
  for (const HandInstrument kind :
       {HandInstrument::composite, HandInstrument::plugger, HandInstrument::carver, HandInstrument::curing_lamp}) {
    command.tool = handInstrumentTool(kind);
    for (int n = 0; n < 50; ++n) servo.step(hand, command, 1e-3);
  }
}

/// A hand away from the tooth for a while, in the longest steps.
void wait(Room& room, double seconds) {
  for (int n = 0; n < static_cast<int>(std::lround(seconds / 0.02)); ++n)
    room.tick = room.servo.step(room.hand, room.command, 0.02);
}

TEST(Filling, AmalgamSetsByItselfAfterItsTime) {
  Room room;
  room.command.tool = handInstrumentTool(HandInstrument::amalgam);
  room.stroke();
  const double laid_mm3 = room.tick.filling.total_mm3;
  ASSERT_GT(laid_mm3, 0.5);
  const Filling& filling = *room.bodies.filling();
  // It was begun 0.8 s ago: the press and the way out.
  wait(room, 269.0);
  EXPECT_EQ(filling.volume_mm3(Tissue::amalgam), 0.0);
  EXPECT_FALSE(filling.hasSet());
  wait(room, 3.0);
  EXPECT_NEAR(filling.volume_mm3(Tissue::amalgam), laid_mm3, 1e-12);
  EXPECT_EQ(filling.volume_mm3(Tissue::amalgam_soft), 0.0);
  EXPECT_NEAR(room.tick.filling.cured_mm3, laid_mm3, 1e-12);
  // What is laid then is another mix, with a time of its own.
  room.go({0.0, 0.0, 2.0}, 100);
  room.stroke();
  EXPECT_EQ(room.tick.filling.increment, 2);
  // In part voxels the larger part names both.
  const double set_mm3 = filling.volume_mm3(Tissue::amalgam);
  EXPECT_GT(filling.volume_mm3(Tissue::amalgam_soft), 0.5);
  wait(room, 250.0);
  EXPECT_NEAR(filling.volume_mm3(Tissue::amalgam), set_mm3, 1e-12);
  wait(room, 25.0);
  EXPECT_EQ(filling.volume_mm3(Tissue::amalgam_soft), 0.0);
}

TEST(Filling, WhatUndoBringsBackHasSetASecondLater) {
  Room room;
  room.command.tool = handInstrumentTool(HandInstrument::amalgam);
  room.stroke();
  const double laid_mm3 = room.tick.filling.total_mm3;
  room.command.tool = handInstrumentTool(HandInstrument::carver);
  room.stroke();
  ASSERT_LT(room.tick.filling.total_mm3, laid_mm3 - 0.01);
  wait(room, 275.0);
  room.command.undo_serial = 1;
  wait(room, 0.1);
  EXPECT_NEAR(room.tick.filling.total_mm3, laid_mm3, 1e-12);
  wait(room, 2.0);
  EXPECT_NEAR(room.bodies.filling()->volume_mm3(Tissue::amalgam), laid_mm3, 1e-12);
}

TEST(Filling, GoesOnSettingWhereItsAgeIsKnown) {
  Room room;
  room.command.tool = handInstrumentTool(HandInstrument::amalgam);
  room.stroke();
  const auto hasSetAfter = [&](double seconds, std::vector<double> age_s) {
    Bodies next = goneOnWith(room.bodies, std::move(age_s));
    Servo servo(next);
    for (int n = 0; n < static_cast<int>(seconds / 0.02); ++n) servo.step(room.hand, room.command, 0.02);
    return next.filling()->volume_mm3(Tissue::amalgam) > 0.0;
  };
  EXPECT_FALSE(hasSetAfter(65.0, {200.0}));
  EXPECT_TRUE(hasSetAfter(75.0, {200.0}));
  EXPECT_FALSE(hasSetAfter(75.0, {}));
}

TEST(Filling, GlassIonomerSetsByLightOrByItself) {
  Room room;
  room.command.tool = handInstrumentTool(HandInstrument::glass_ionomer);
  room.stroke();
  wait(room, 288.0);
  EXPECT_EQ(room.tick.filling.cured_mm3, 0.0);
  wait(room, 5.0);
  EXPECT_NEAR(room.tick.filling.cured_mm3, room.tick.filling.total_mm3, 1e-12);
}

TEST(Filling, SetsWithoutAllocating) {
  Room room;
  room.command.tool = handInstrumentTool(HandInstrument::amalgam);
  room.stroke();
  wait(room, 269.0);
  const std::size_t before = allocation_count::now();
  wait(room, 3.0);
  EXPECT_EQ(allocation_count::now(), before);
  EXPECT_GT(room.tick.filling.cured_mm3, 0.0);
}

}  // namespace
}  // namespace haptics
