#include "haptics/body/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptics/body/piece_split.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/contact/law.h"
#include "haptics/contact/overlap.h"
#include "haptics/contact/shape_overlap.h"
#include "haptics/servo/proxy.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Piece;
using calibration::Pose;
using calibration::Tool;

constexpr std::uint8_t kBone = 1, kDentine = 5;

/// A block of bone up to z = 0 around a tooth, a box of dentine that stands 1 mm out of it.
struct Site {
  Phantom phantom = filled(6.0, 0.25, [](const glm::dvec3& p) { return insideTooth(p) ? -1e3 : p.z; });
  std::vector<std::uint8_t> label, is_tooth;

  static bool insideTooth(const glm::dvec3& p) {
    return std::abs(p.x) < 2.5 && std::abs(p.y) < 2.0 && std::abs(p.z + 1.0) < 2.0;
  }
  Site() : label(phantom.solid.size(), kBone), is_tooth(phantom.solid.size(), 0) {
    assets::forVoxels(phantom.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (!insideTooth(phantom.grid.centre_P_mm(ijk))) return;
      label[v] = kDentine;
      is_tooth[v] = 1;
    });
  }
  Bodies divided() const { return {phantom.grid, phantom.solid, label, is_tooth}; }
  Bodies whole() const { return {phantom.grid, phantom.solid, label}; }
};

/// Heads over and in the border of tooth and bone.
struct Probe {
  BurShape head;
  Pose<Patient, Tool> X_PT;
};
std::vector<Probe> probes() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3.5, 3.5), turn(-1.0, 1.0);
  std::vector<Probe> probes;
  for (const BurShape& head : {BurShape{ShapeKind::sphere, 1.0, 0.0}, BurShape{ShapeKind::sphere, 0.4, 0.0},
                               BurShape{ShapeKind::cylinder, 0.8, 2.0}, BurShape{ShapeKind::capsule, 0.7, 1.0},
                               BurShape{ShapeKind::cone, 1.0, 2.0}})
    for (int n = 0; n < 12; ++n)
      probes.push_back({head,
                        {glm::normalize(glm::dquat(1.0, turn(random), turn(random), turn(random))),
                         {place(random), place(random), 0.4 * place(random)}}});
  return probes;
}

/// The erosion of one short step.
ErosionStep someStep() {
  ErosionStep step;
  step.loss.fill(0.3);
  return step;
}

TEST(Bodies, ToothIsABodyOfItsOwn) {
  const Bodies bodies = Site().divided();
  EXPECT_EQ(bodies.pieces(), 1u);
  EXPECT_TRUE(bodies.isAtRest(0));
  EXPECT_EQ(Site().whole().pieces(), 0u);
}

TEST(Bodies, AtRestOverlapsAreThoseOfTheWholeVolume) {
  const Site site;
  const Bodies divided = site.divided(), whole = site.whole();
  const TissueStiffness even{};
  for (const Probe& at : probes()) {
    const ShapeOverlap one = shapeOverlap(whole.view(), at.head, at.X_PT, even);
    const ShapeOverlap sum = shapeOverlap(divided.view(), at.head, at.X_PT, even);
    EXPECT_NEAR(sum.volume_mm3, one.volume_mm3, 1e-5 * one.volume_mm3 + 1e-9);
    EXPECT_NEAR(glm::length(sum.first_moment_P_mm4.xyz - one.first_moment_P_mm4.xyz), 0.0,
                1e-5 * one.volume_mm3 + 1e-9);
    EXPECT_NEAR(glm::length(sum.area_P_mm2.xyz - one.area_P_mm2.xyz), 0.0, 1e-4);
    if (at.head.kind != ShapeKind::sphere) continue;
    const calibration::Point<Patient> centre{at.X_PT.translation_mm};
    const SphereOverlap ball = sphereOverlap(whole.view(), centre, at.head.radius_mm);
    const SphereOverlap balls = sphereOverlap(divided.view(), centre, at.head.radius_mm);
    EXPECT_NEAR(balls.volume_mm3, ball.volume_mm3, 1e-5 * ball.volume_mm3 + 1e-9);
    EXPECT_NEAR(glm::length(balls.first_moment_P_mm4.xyz - ball.first_moment_P_mm4.xyz), 0.0,
                1e-5 * ball.volume_mm3 + 1e-9);
  }
}

TEST(Bodies, AtRestEveryLawFeelsTheWholeVolume) {
  // Not bit for bit: where both share a voxel, two soft faces stand for one solid voxel, and its tissue is a mixture.
  // As deep as a proxy goes.
  const Site site;
  const Bodies divided = site.divided(), whole = site.whole();
  for (const LawName& name : kLaws)
    for (const Probe& at : probes()) {
      LawSettings law;
      law.kind = name.kind;
      if (!supports(law.kind, at.head.kind)) continue;
      const Contact one = contactOf(law, {whole.view(), at.head, at.X_PT, law.tissue, {}});
      if (one.depth_mm > maxLawDepth_mm(at.head)) continue;
      const Contact two = contactOf(law, {divided.view(), at.head, at.X_PT, law.tissue, {}});
      EXPECT_NEAR(two.depth_mm, one.depth_mm, 0.02) << name.key;
      EXPECT_NEAR(glm::length(two.force_P_N.xyz - one.force_P_N.xyz), 0.0, 0.05 * glm::length(one.force_P_N.xyz) + 0.02)
          << name.key;
    }
}

TEST(Bodies, MovedTogetherWithTheToolAPieceFeelsTheSame) {
  // A tooth alone: the wrench turns with the pose.
  Site site;
  for (std::size_t v = 0; v < site.is_tooth.size(); ++v)
    if (site.is_tooth[v] == 0) site.phantom.solid[v] = 0;
  const Bodies rest = site.divided();
  Bodies moved = site.divided();
  const Pose<Patient, Piece> X_PQ{glm::normalize(glm::dquat(0.8, 0.3, -0.4, 0.2)), {1.7, -2.2, 3.1}};
  moved.place(0, X_PQ);
  EXPECT_FALSE(moved.isAtRest(0));
  for (const LawName& name : kLaws)
    for (const Probe& at : probes()) {
      LawSettings law;
      law.kind = name.kind;
      if (!supports(law.kind, at.head.kind)) continue;
      const Pose<Patient, Tool> along = X_PQ * Pose<Piece, Tool>{at.X_PT.rotation, at.X_PT.translation_mm};
      const Contact before = contactOf(law, {rest.view(), at.head, at.X_PT, law.tissue, {}});
      const Contact after = contactOf(law, {moved.view(), at.head, along, law.tissue, {}});
      EXPECT_NEAR(after.depth_mm, before.depth_mm, 1e-6) << name.key;
      EXPECT_NEAR(glm::length(after.force_P_N.xyz - X_PQ.rotation * before.force_P_N.xyz), 0.0, 1e-5) << name.key;
      EXPECT_NEAR(glm::length(after.torque_P_Nmm.xyz - X_PQ.rotation * before.torque_P_Nmm.xyz), 0.0, 1e-4) << name.key;
    }
}

TEST(Bodies, AtRestTheBurRemovesWhatItWouldRemoveFromTheWhole) {
  const Site site;
  Bodies divided = site.divided(), whole = site.whole();
  double by_two_mm3 = 0.0, by_one_mm3 = 0.0;
  std::uint64_t tick = 0;
  for (const Probe& at : probes())
    for (int n = 0; n < 20; ++n) {
      by_two_mm3 += carveTool(divided, at.head, at.X_PT, someStep(), ++tick).removed_mm3;
      by_one_mm3 += carveTool(whole, at.head, at.X_PT, someStep(), tick).removed_mm3;
    }
  EXPECT_GT(by_one_mm3, 50.0);
  EXPECT_NEAR(by_two_mm3, by_one_mm3, 0.005 * by_one_mm3);
  // One rounding a body.
  const auto left = divided.solidInGridOrder(), expected = whole.solidInGridOrder();
  int worst = 0;
  for (std::size_t v = 0; v < left.size(); ++v) worst = std::max(worst, std::abs(left[v] - expected[v]));
  EXPECT_LE(worst, 3);
}

TEST(Bodies, AMovedPieceIsCutWhereItIs) {
  const Site site;
  Bodies bodies = site.divided();
  bodies.place(0, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 8.0}});
  const BurShape head{ShapeKind::sphere, 1.0, 0.0};
  const CarveResult removed = carveTool(bodies, head, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 9.0}}, someStep(), 1);
  EXPECT_GT(removed.removed_mm3_by_label[kDentine], 0.0);
  EXPECT_EQ(removed.removed_mm3_by_label[kBone], 0.0);
  const CarveResult nothing = carveTool(bodies, head, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}, someStep(), 2);
  EXPECT_EQ(nothing.removed_mm3, 0.0) << "the tooth has left its socket";
}

TEST(Bodies, DigestFollowsEveryByteAndPose) {
  const Site site;
  EXPECT_EQ(site.divided().digest(), site.divided().digest());
  EXPECT_NE(site.divided().digest(), site.whole().digest());
  EXPECT_EQ(site.whole().digest(), site.phantom.bone(kBone).digest()) << "of the jaw alone it is the bone's";
  Bodies moved = site.divided();
  moved.place(0, {{1.0, 0.0, 0.0, 0.0}, {1e-12, 0.0, 0.0}});
  EXPECT_NE(moved.digest(), site.divided().digest());
  moved.place(0, {});
  EXPECT_EQ(moved.digest(), site.divided().digest());
  Bodies cut = site.divided();
  carveTool(cut, {ShapeKind::sphere, 0.5, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}}, someStep(), 1);
  EXPECT_NE(cut.digest(), site.divided().digest()) << "the tooth alone was cut";
}

TEST(Bodies, OneStrokeOverBothIsUndoneAndRedoneWhole) {
  const Site site;
  Bodies bodies = site.divided();
  StrokeHistory strokes(bodies.bones());
  const std::uint64_t before = bodies.digest();
  for (std::uint64_t tick = 1; tick <= 20; ++tick)
    carveTool(bodies, {ShapeKind::sphere, 1.2, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {2.5, 0.0, 0.0}}, someStep(), tick, 1,
              &strokes);
  strokes.endStroke();
  const std::uint64_t after = bodies.digest();
  const auto removed = bodies.removedByTissue_mm3();
  EXPECT_GT(removed[kBone], 0.1);
  EXPECT_GT(removed[kDentine], 0.1);
  const StrokeHistory::Restored undone = strokes.undo(bodies.bones(), 100'000);
  EXPECT_EQ(bodies.digest(), before);
  EXPECT_NEAR(undone.volume_mm3, removed[kBone] + removed[kDentine], 1e-9);
  strokes.redo(bodies.bones(), 100'000);
  EXPECT_EQ(bodies.digest(), after);
}

TEST(Bodies, AMovedToothIsInTheMouthUntilItIsSetAside) {
  const Site site;
  Bodies bodies = site.divided();
  const std::vector<std::uint8_t> whole = bodies.solidInGridOrder();
  bodies.place(0, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  EXPECT_NE(bodies.solidInGridOrder(), whole);
  EXPECT_EQ(bodies.solidInMouth(), whole);
  bodies.setAside(0);
  EXPECT_TRUE(bodies.isSetAside(0));
  EXPECT_EQ(bodies.solidInMouth(), bodies.jaw().solidInGridOrder());
}

/// All of the tooth's solid with x < 0.
SplitPlan leftHalf(const Bodies& bodies) {
  const CarvedBone& tooth = bodies.bones()[1];
  std::vector<std::uint8_t> bytes = tooth.solidInGridOrder();
  assets::forVoxels(tooth.grid(), [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.grid().centre_P_mm(ijk).x >= 0.0) bytes[v] = 0;
  });
  return splitPlan(tooth.grid(), bytes);
}

void split(Bodies& bodies, const SplitPlan& plan, StrokeHistory* strokes = nullptr) {
  for (const SplitPlan::Block& block : plan.blocks) bodies.moveBlock(0, 1, block.block, block.given, strokes);
}

void cutAt(Bodies& bodies, const glm::dvec3& p_P_mm, std::uint64_t first_tick, StrokeHistory* strokes = nullptr) {
  for (std::uint64_t tick = first_tick; tick < first_tick + 5; ++tick)
    carveTool(bodies, {ShapeKind::sphere, 0.8, 0.0}, {{1.0, 0.0, 0.0, 0.0}, p_P_mm}, someStep(), tick, 1, strokes);
}

TEST(Bodies, PiecesHoldWhatTheToothHeld) {
  const Site site;
  Bodies bodies = site.divided();
  cutAt(bodies, {0.0, 0.0, 1.0}, 1);
  const std::vector<std::uint8_t> before = bodies.solidInGridOrder(), tooth = bodies.bones()[1].solidInGridOrder();
  const auto removed_mm3 = bodies.removedByTissue_mm3();
  split(bodies, leftHalf(bodies));
  EXPECT_EQ(bodies.pieces(), 2u);
  EXPECT_EQ(bodies.solidInGridOrder(), before);
  const auto first = bodies.bones()[1].solidInGridOrder(), second = bodies.bones()[2].solidInGridOrder();
  const assets::VolumeGrid& grid = bodies.bones()[1].grid();
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const bool is_left = grid.centre_P_mm(ijk).x < 0.0;
    EXPECT_EQ(is_left ? second[v] : first[v], tooth[v]);
    EXPECT_EQ(is_left ? first[v] : second[v], 0);
  });
  for (std::size_t tissue = 0; tissue < assets::kTissueCount; ++tissue)
    EXPECT_NEAR(bodies.removedByTissue_mm3()[tissue], removed_mm3[tissue], 1e-9);
}

/// A voxel goes on losing what it would have lost: the pieces have its history, also of what was cut in part before.
TEST(Bodies, PiecesAreCutAsTheToothWouldHaveBeen) {
  const Site site;
  Bodies whole = site.divided(), parted = site.divided();
  for (const double x : {-0.9, 0.7}) {
    cutAt(whole, {x, 0.3, 0.8}, 1);
    cutAt(parted, {x, 0.3, 0.8}, 1);
  }
  split(parted, leftHalf(parted));
  for (const double x : {-1.2, 0.0, 1.0}) {
    cutAt(whole, {x, 0.5, 0.4}, 10);
    cutAt(parted, {x, 0.5, 0.4}, 10);
    EXPECT_EQ(whole.solidInGridOrder(), parted.solidInGridOrder()) << x;
  }
  EXPECT_GT(whole.removedByTissue_mm3()[kDentine], 1.0);
}

TEST(Bodies, AByteSharedByTwoPiecesIsKeptToTheStep) {
  const Site site;
  Bodies bodies = site.divided();
  cutAt(bodies, {0.0, 0.0, 1.0}, 1);
  const std::vector<std::uint8_t> before = bodies.solidInGridOrder();
  std::mt19937 random(3);
  SplitPlan plan = leftHalf(bodies);
  for (SplitPlan::Block& block : plan.blocks)
    for (std::uint8_t& given : block.given) given = static_cast<std::uint8_t>(random() % (given + 1u));
  split(bodies, plan);
  EXPECT_EQ(bodies.solidInGridOrder(), before);
  // A cut that only reaches a corner changes nothing else in its blocks.
  const std::vector<std::uint8_t> first = bodies.bones()[1].solidInGridOrder();
  const std::vector<std::uint8_t> second = bodies.bones()[2].solidInGridOrder();
  cutAt(bodies, {-2.4, 0.0, 1.4}, 30);
  const assets::VolumeGrid& grid = bodies.bones()[1].grid();
  const auto now_first = bodies.bones()[1].solidInGridOrder(), now_second = bodies.bones()[2].solidInGridOrder();
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (glm::distance(grid.centre_P_mm(ijk), glm::dvec3(-2.4, 0.0, 1.4)) < 1.1) return;
    EXPECT_EQ(now_first[v], first[v]);
    EXPECT_EQ(now_second[v], second[v]);
  });
}

TEST(Bodies, AStrokeWithItsSplitIsUndoneAndRedoneWhole) {
  const Site site;
  Bodies bodies = site.divided();
  StrokeHistory strokes(bodies.bones());
  const std::uint64_t before = bodies.digest();
  cutAt(bodies, {0.0, 0.0, 0.5}, 1, &strokes);
  strokes.endStroke();
  const std::uint64_t cut = bodies.digest();
  strokes.reopen();
  split(bodies, leftHalf(bodies), &strokes);
  strokes.endStroke();
  const std::uint64_t parted = bodies.digest();
  EXPECT_NE(parted, cut);
  EXPECT_EQ(strokes.strokes(), 1u);
  cutAt(bodies, {-1.0, 0.0, 0.5}, 20, &strokes);
  strokes.undo(bodies.bones(), 100'000);
  EXPECT_EQ(bodies.digest(), parted);
  strokes.undo(bodies.bones(), 100'000);
  EXPECT_EQ(bodies.digest(), before);
  EXPECT_EQ(bodies.pieces(), 1u);
  strokes.redo(bodies.bones(), 100'000);
  EXPECT_EQ(bodies.digest(), parted);
  EXPECT_EQ(bodies.pieces(), 2u);
}

TEST(Bodies, DirtyBricksCoverAllThatWasCutInJawAndTooth) {
  const Site site;
  Bodies bodies = site.divided();
  std::vector<glm::ivec3> dirty;
  bodies.takeDirtyBricks(dirty);
  EXPECT_TRUE(dirty.empty());
  for (std::uint64_t tick = 1; tick <= 10; ++tick)
    carveTool(bodies, {ShapeKind::sphere, 1.2, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {2.5, 0.5, 0.0}}, someStep(), tick);
  bodies.takeDirtyBricks(dirty);
  EXPECT_FALSE(dirty.empty());

  // The bytes of jaw and tooth there, put into the initial volume, give what is left.
  std::vector<std::uint8_t> shown = site.phantom.solid;
  for (const glm::ivec3 brick : dirty) {
    const std::vector<std::uint8_t> jaw = bodies.jaw().copyBox(brick, glm::ivec3(8));
    std::vector<std::uint8_t> tooth(jaw.size(), 0);
    if (const auto own = bodies.brickOfPiece(brick)) tooth = bodies.bones()[1].copyBox(*own, glm::ivec3(8));
    assets::forVoxels(glm::ivec3(0), glm::ivec3(8), [&](glm::ivec3 within) {
      const glm::ivec3 ijk = brick * 8 + within;
      const std::size_t v = assets::indexIn(glm::ivec3(8), within);
      if (bodies.grid().contains(ijk))
        shown[bodies.grid().index(ijk)] = static_cast<std::uint8_t>(std::min(255, jaw[v] + tooth[v]));
    });
  }
  EXPECT_EQ(shown, bodies.solidInGridOrder());
}

TEST(Bodies, ServoReplaysAToothAndItsJawBitForBit) {
  const Site site;
  const auto run = [&](Bodies& bodies) {
    Servo servo(bodies);
    Command command;
    command.tool.head.radius_mm = 1.0;
    std::vector<Tick> ticks;
    for (int n = 0; n < 400; ++n) {
      HandSample hand;
      hand.X_PT.translation_mm = {4.5 - 0.01 * n, 0.3, 0.6};
      hand.velocity_P_mm_per_s.xyz = {-10.0, 0.0, 0.0};
      hand.drill_pedal = true;
      ticks.push_back(servo.step(hand, command, 1e-3));
    }
    return ticks;
  };
  Bodies first = site.divided(), second = site.divided();
  const auto a = run(first), b = run(second);
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].bone_digest, b[n].bone_digest);
    EXPECT_EQ(a[n].commanded_force_P_N.xyz, b[n].commanded_force_P_N.xyz);
  }
  EXPECT_EQ(a.back().bone_digest, first.digest());
  EXPECT_GT(a.back().removed_total_mm3[kDentine], 0.1);
  EXPECT_GT(a.back().removed_total_mm3[kBone], 0.01);
}

}  // namespace
}  // namespace haptics
