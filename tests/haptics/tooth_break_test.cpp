// A sectioned tooth whose bridge breaks under forceps: when, what becomes of both parts, undo, and what is refused.
#include "haptics/servo/tooth_break.h"

#include <gtest/gtest.h>

#include "haptics/body/bridge_break.h"
#include "haptics/body/bridge_strength.h"
#include "haptics/body/tooth_survey.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/socketed_tooth.h"

namespace haptics {
namespace {

using namespace phantom;

/// A tooth held by some 9 mm2.
struct Sectioned : Mouth {
  std::optional<BreakPlan> plan;

  Sectioned() : Mouth(false, -0.6) { plan = planned(); }

  std::optional<BreakPlan> planned() const {
    const CarvedBone& tooth = bodies.bones()[1];
    const Mouth whole;
    EXPECT_EQ(whole.bodies.bones()[1].grid(), tooth.grid());
    ToothSurvey survey(tooth.grid(), whole.bodies.bones()[1].solidInGridOrder());
    assets::forVoxels(glm::ivec3(0), tooth.grid().bricks(), [&](glm::ivec3 brick) {
      std::array<std::uint8_t, 512> bytes{};
      tooth.copyBrick(brick, bytes);
      survey.update(brick, bytes);
    });
    ToothFindings found = survey.pieces();
    survey.findBridges(found, 0.25);
    EXPECT_EQ(found.held[0].bridges, 1u);
    return breakPlan(Components(tooth.grid(), tooth.solidInGridOrder()), tooth.labelInGridOrder(),
                     found.held[0].bridge[0]);
  }
  void arm() {
    command.bridge = {command.bridge.serial + 1, bodies.digest(), 0, plan->digest, plan->bridge, &*plan};
    ++command.serial;
    step();
  }
  /// Twists the crown about the width of the bridge until it breaks. Returns the tick of the break, if it came.
  Tick twist(double most_rad = 0.6) {
    const Tick before = tick;
    const glm::dvec3 at_mm = hand.X_PT.translation_mm;
    for (int n = 1; n <= 600; ++n) {
      hand.X_PT.rotation = glm::angleAxis(most_rad * n / 600.0, glm::dvec3(0.0, 1.0, 0.0));
      hand.X_PT.translation_mm = at_mm;
      step();
      if (tick.broken.piece != 0) return tick;
    }
    Tick none = before;
    none.broken = {};
    return none;
  }
  long bytesOf(std::size_t bone) const {
    long sum = 0;
    for (const std::uint8_t byte : bodies.bones()[bone].solidInGridOrder()) sum += byte;
    return sum;
  }
};

TEST(ToothBreak, ForcepsBreakTheBridgeAndBothPartsKeepAllSolid) {
  Sectioned room;
  ASSERT_TRUE(room.plan);
  const long before = room.bytesOf(1);
  room.arm();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::armed);
  room.makeReady();
  room.grip();
  ASSERT_EQ(room.tick.gripped, 1);
  const Tick broke = room.twist();
  ASSERT_EQ(broke.broken.piece, 1);
  EXPECT_TRUE(broke.broken.is_complete);
  EXPECT_NEAR(broke.broken.area_mm2, room.plan->bridge.area_mm2, 1e-12);
  EXPECT_GE(broke.bridge_share, 1.0);
  EXPECT_LT(broke.bridge_share, 1.2) << "as soon as it could";
  EXPECT_EQ(broke.bridge, BreakAnswer::breaking);
  // By hand: the grip's wrench about the centre of the bridge.
  const glm::dvec3 centre_mm =
      room.bodies.pose(0).rotation * room.plan->bridge.centre_mm + room.bodies.pose(0).translation_mm;
  const glm::dvec3 arm_mm = broke.proxy_P.mm - centre_mm;
  const glm::dvec3 moment = broke.grip_torque_P_Nmm.xyz + glm::cross(arm_mm, broke.grip_force_P_N.xyz);
  const glm::dvec3 normal = room.bodies.pose(0).rotation * room.plan->bridge.normal;
  EXPECT_NEAR(broke.broken.bending_Nmm, glm::length(moment - glm::dot(moment, normal) * normal), 1e-6);
  EXPECT_NEAR(broke.broken.force_N, glm::length(broke.grip_force_P_N.xyz), 1e-9);

  room.step(200);
  EXPECT_EQ(room.tick.gripped, 0);
  EXPECT_EQ(room.tick.pieces, 2);
  EXPECT_EQ(room.tick.bridge, BreakAnswer::outdated);
  EXPECT_EQ(room.bytesOf(1) + room.bytesOf(2), before);
  EXPECT_EQ(room.bodies.pose(0).translation_mm, room.bodies.pose(1).translation_mm);
  for (const std::size_t bone : {1u, 2u}) {
    const CarvedBone& part = room.bodies.bones()[bone];
    const Components pieces(part.grid(), part.solidInGridOrder());
    EXPECT_GT(pieces.pieces()[0].volume_mm3, 20.0);
    for (std::size_t n = 1; n < pieces.pieces().size(); ++n) EXPECT_LT(pieces.pieces()[n].volume_mm3, kLeastPiece_mm3);
  }
}

/// The blade lies in the slot, its width along the slot's floor, and is twisted about its shaft.
TEST(ToothBreak, AnElevatorTwistedInTheSlotBreaksItAtItsForce) {
  Sectioned room;
  const glm::dquat flat(0.5, 0.5, 0.5, 0.5);
  room.command.tool = elevatorTool(ElevatorKind::straight_301);
  room.hand.X_PT = {flat, {9.0, 0.0, 1.0}};
  room.step(50);
  room.arm();
  room.makeReady();
  const glm::dvec3 in_slot_mm(0.6, 0.0, 1.0);
  room.go(in_slot_mm, 1.0, flat);
  ASSERT_EQ(room.tick.lever.piece, 1);
  double most_share = 0.0;
  for (int n = 1; n <= 1500 && room.tick.broken.piece == 0; ++n) {
    room.hand.X_PT.rotation = flat * glm::angleAxis(0.001 * n, glm::dvec3(0.0, 0.0, 1.0));
    room.step();
    most_share = std::max(most_share, room.tick.bridge_share);
  }
  ASSERT_EQ(room.tick.broken.piece, 1) << most_share << " of what breaks it";
  EXPECT_NEAR(room.tick.broken.force_N, room.tick.lever.wedging_N, 1e-9);
  const double force_N = breakingForce_N(room.plan->bridge, room.plan->enamel_share);
  EXPECT_GE(room.tick.broken.force_N, force_N);
  EXPECT_LT(room.tick.broken.force_N, 1.2 * force_N) << "as soon as it could";
  room.step(200);
  EXPECT_EQ(room.tick.pieces, 2);
  EXPECT_EQ(room.tick.lever.piece, 0) << "the parts have no site yet";
  EXPECT_EQ(room.tick.strokes, 1);
  ++room.command.undo_serial, ++room.command.serial;
  room.step(200);
  EXPECT_EQ(room.tick.pieces, 1);
}

TEST(ToothBreak, WithoutAnOrderItHolds) {
  Sectioned room;
  room.makeReady();
  room.grip();
  EXPECT_EQ(room.twist().broken.piece, 0);
  EXPECT_EQ(room.tick.pieces, 1);
  EXPECT_EQ(room.tick.bridge_share, 0.0);
}

TEST(ToothBreak, UndoMakesTheToothWholeAndRedoBreaksItAgain) {
  Sectioned room;
  const std::uint64_t first = room.bodies.digest();
  room.arm();
  room.makeReady();
  room.grip();
  ASSERT_EQ(room.twist().broken.piece, 1);
  room.step(100);
  room.release();
  ASSERT_EQ(room.tick.strokes, 1);
  const std::uint64_t broken = room.bodies.digest();
  ++room.command.undo_serial, ++room.command.serial;
  room.step(200);
  EXPECT_EQ(room.bodies.digest(), first);
  EXPECT_EQ(room.tick.pieces, 1);
  EXPECT_EQ(room.tick.bridge, BreakAnswer::armed) << "the same bytes, the same bridge";
  ++room.command.redo_serial, ++room.command.serial;
  room.step(200);
  EXPECT_EQ(room.bodies.digest(), broken);
  EXPECT_EQ(room.tick.pieces, 2);
  ++room.command.undo_serial, ++room.command.serial;
  room.step(200);
  // It breaks anew.
  room.hand.X_PT = {glm::dquat(1.0, 0.0, 0.0, 0.0), {6.0, 0.0, 2.0}};
  room.step(300);
  room.makeReady();
  room.grip();
  EXPECT_EQ(room.twist().broken.piece, 1);
}

TEST(ToothBreak, AnOrderForOtherBodiesOrAnotherPlanIsRefused) {
  Sectioned room;
  room.command.bridge = {1, room.bodies.digest() ^ 1, 0, room.plan->digest, room.plan->bridge, &*room.plan};
  room.step();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::refused);
  room.command.bridge = {2, room.bodies.digest(), 0, room.plan->digest ^ 1, room.plan->bridge, &*room.plan};
  room.step();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::refused);
  room.command.bridge = {3, room.bodies.digest(), 0, room.plan->digest, room.plan->bridge, nullptr};
  room.step();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::refused);
  room.command.bridge = {4, room.bodies.digest(), 1, room.plan->digest, room.plan->bridge, &*room.plan};
  room.step();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::refused);
  room.command.bridge = {5, room.bodies.digest(), 0, room.plan->digest, room.plan->bridge, &*room.plan};
  room.step();
  EXPECT_EQ(room.tick.bridge, BreakAnswer::armed);
}

/// The bur takes some more of the tooth: the plan is of other bytes.
TEST(ToothBreak, ACutMakesThePlanOutOfDate) {
  Sectioned room;
  room.arm();
  room.command.tool = {};
  room.command.tool.head = {ShapeKind::sphere, 0.8, 0.0};
  room.hand.X_PT.translation_mm = {0.0, 0.0, 6.0};
  room.step(50);
  room.hand.drill_pedal = true;
  room.go({0.0, 0.0, 4.0}, 0.5);
  EXPECT_EQ(room.tick.bridge, BreakAnswer::outdated);
  room.hand.drill_pedal = false;
  room.go({0.0, 0.0, 8.0}, 0.5);
  ++room.command.undo_serial, ++room.command.serial;
  room.step(100);
  EXPECT_EQ(room.tick.bridge, BreakAnswer::armed);
}

TEST(ToothBreak, AllocatesNothing) {
  Sectioned room;
  room.arm();
  room.makeReady();
  const std::size_t before = allocation_count::now();
  room.grip();
  ASSERT_EQ(room.twist().broken.piece, 1);
  room.step(50);
  EXPECT_EQ(room.tick.pieces, 2);
  EXPECT_EQ(allocation_count::now(), before);
}

TEST(ToothBreak, AWedgeBreaksItAtItsForceAndAThickOneNever) {
  Sectioned room;
  const double force_N = breakingForce_N(room.plan->bridge, room.plan->enamel_share);
  ToothBreak breaks;
  breaks.receive(room.bodies, {1, room.bodies.digest(), 0, room.plan->digest, room.plan->bridge, &*room.plan});
  breaks.wedge(room.bodies, 0, 0.99 * force_N);
  EXPECT_NEAR(breaks.share(), 0.99, 1e-9);
  EXPECT_EQ(breaks.broken().piece, 0);
  breaks.wedge(room.bodies, 0, 1.01 * force_N);
  EXPECT_EQ(breaks.broken().piece, 1);
  EXPECT_NEAR(breaks.broken().force_N, 1.01 * force_N, 1e-9);
  breaks.reset();
  EXPECT_EQ(breaks.broken().piece, 0);
  breaks.wedge(room.bodies, 0, -1e4);
  EXPECT_EQ(breaks.share(), 0.0) << "walls pressed together";
  BreakPlan thick = *room.plan;
  thick.bridge.area_mm2 = 41.0;
  breaks.receive(room.bodies, {2, room.bodies.digest(), 0, thick.digest, thick.bridge, &thick});
  breaks.wedge(room.bodies, 0, 1e5);
  EXPECT_EQ(breaks.broken().piece, 0);
}

}  // namespace
}  // namespace haptics
