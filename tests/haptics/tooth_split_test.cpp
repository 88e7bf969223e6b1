#include "haptics/servo/tooth_split.h"

#include <gtest/gtest.h>

#include "haptics/body/piece_split.h"
#include "haptics/servo/servo.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

/// Bone up to z = 0 around a tooth that a slot at x = 0 has parted, and a hand over it.
struct PartedTooth {
  Phantom phantom = filled(6.0, 0.25, [](const glm::dvec3& p) { return inSlot(p) ? 1e3 : p.z; });
  std::vector<std::uint8_t> label, is_tooth;
  Bodies bodies;
  Servo servo{bodies};
  Command command;
  HandSample hand;
  SplitPlan plan;
  Tick tick;

  static bool insideTooth(const glm::dvec3& p) {
    return std::abs(p.x) < 3.0 && std::abs(p.y) < 2.0 && p.z > -4.0 && p.z < 0.5;
  }
  static bool inSlot(const glm::dvec3& p) { return insideTooth(p) && std::abs(p.x - 0.5) < 0.5; }

  PartedTooth()
      : label(phantom.solid.size(), 1), is_tooth(phantom.solid.size(), 0), bodies([this] {
          assets::forVoxels(phantom.grid, [&](glm::ivec3 ijk, std::size_t v) {
            is_tooth[v] = insideTooth(phantom.grid.centre_P_mm(ijk));
          });
          return Bodies(phantom.grid, phantom.solid, label, is_tooth);
        }()) {
    command.tool.head = {ShapeKind::sphere, 0.8, 0.0};
    hand.X_PT.translation_mm = {-1.5, 0.0, 3.0};
  }

  void step(int ticks = 1) {
    for (int n = 0; n < ticks; ++n) tick = servo.step(hand, command, 1e-3);
  }
  void order() {
    const CarvedBone& tooth = bodies.bones()[1];
    plan = partingPlan(Components(tooth.grid(), tooth.solidInGridOrder()));
    command.split = {command.split.serial + 1, bodies.digest(), 0, &plan};
    ++command.serial;
  }
  void cut() {
    hand.drill_pedal = true;
    for (int n = 0; n < 300; ++n) {
      hand.X_PT.translation_mm.z = 1.5 - 0.005 * n;
      step();
    }
    hand.drill_pedal = false;
    hand.X_PT.translation_mm.z = 3.0;
    step(400);
  }
};

TEST(ToothSplit, ComesInBoundedStepsAndChangesNothingThatIsFelt) {
  PartedTooth room;
  room.step();
  const std::vector<std::uint8_t> before = room.bodies.solidInGridOrder();
  EXPECT_EQ(room.tick.pieces, 1);
  room.order();
  ASSERT_GT(room.plan.blocks.size(), 3 * ToothSplit::kBlocksPerTick);
  std::size_t running = 0;
  for (int n = 0; n < 100; ++n) {
    room.step();
    running += room.tick.split == SplitAnswer::running;
    EXPECT_EQ(room.bodies.solidInGridOrder(), before) << "tick " << n;
    if (room.tick.split == SplitAnswer::done) break;
  }
  EXPECT_EQ(room.tick.split, SplitAnswer::done);
  EXPECT_EQ(running, (room.plan.blocks.size() - 1) / ToothSplit::kBlocksPerTick);
  EXPECT_EQ(room.tick.pieces, 2);
  EXPECT_EQ(Components(room.bodies.bones()[1].grid(), room.bodies.bones()[1].solidInGridOrder()).pieces().size(), 1u);
  EXPECT_EQ(Components(room.bodies.bones()[2].grid(), room.bodies.bones()[2].solidInGridOrder()).pieces().size(), 1u);
  EXPECT_EQ(room.tick.strokes, 0) << "nothing was cut, so there is nothing to undo";
}

TEST(ToothSplit, WaitsUntilTheToolIsClear) {
  PartedTooth room;
  room.hand.X_PT.translation_mm = {-1.5, 0.0, 0.5};
  room.step(5);
  ASSERT_GT(room.tick.overlap_mm3, 0.0);
  room.order();
  room.step(20);
  EXPECT_EQ(room.tick.split, SplitAnswer::waiting);
  EXPECT_EQ(room.tick.pieces, 1);
  room.hand.X_PT.translation_mm.z = 3.0;
  room.step(30);
  EXPECT_EQ(room.tick.split, SplitAnswer::done);
}

TEST(ToothSplit, IsRefusedWhenTheBodiesAreOthers) {
  PartedTooth room;
  room.order();
  room.command.split.bodies_digest ^= 1;
  room.step(3);
  EXPECT_EQ(room.tick.split, SplitAnswer::refused);
  EXPECT_EQ(room.tick.pieces, 1);
  // Without a plan, of a piece that is not there.
  room.order();
  room.command.split.plan = nullptr;
  room.step(3);
  EXPECT_EQ(room.tick.split, SplitAnswer::refused);
  room.order();
  room.command.split.piece = 1;
  room.step(3);
  EXPECT_EQ(room.tick.split, SplitAnswer::refused);
  // Cut while it waits.
  room.hand.X_PT.translation_mm = {-1.5, 0.0, 0.4};
  room.step(5);
  room.order();
  room.step(2);
  ASSERT_EQ(room.tick.split, SplitAnswer::waiting);
  room.hand.drill_pedal = true;
  room.step(50);
  EXPECT_EQ(room.tick.split, SplitAnswer::refused);
  EXPECT_EQ(room.tick.pieces, 1);
  // And asked again.
  room.hand.drill_pedal = false;
  room.hand.X_PT.translation_mm.z = 3.0;
  room.step(400);
  room.order();
  room.step(40);
  EXPECT_EQ(room.tick.split, SplitAnswer::done);
}

TEST(ToothSplit, GoesAndComesWithTheStrokeThatMadeIt) {
  PartedTooth room;
  room.step();
  const std::uint64_t first = room.bodies.digest();
  room.cut();
  ASSERT_EQ(room.tick.strokes, 1);
  room.order();
  room.step(60);
  ASSERT_EQ(room.tick.split, SplitAnswer::done);
  EXPECT_EQ(room.tick.strokes, 1);
  const std::uint64_t parted = room.bodies.digest();
  ++room.command.undo_serial;
  room.step(100);
  EXPECT_EQ(room.bodies.digest(), first);
  EXPECT_EQ(room.tick.pieces, 1);
  EXPECT_EQ(room.tick.strokes, 0);
  ++room.command.redo_serial;
  room.step(100);
  EXPECT_EQ(room.bodies.digest(), parted);
  EXPECT_EQ(room.tick.pieces, 2);
  // An undo that is asked for meanwhile waits for the end.
  ++room.command.undo_serial;
  room.step(100);
  room.cut();
  room.order();
  room.step(2);
  ASSERT_EQ(room.tick.split, SplitAnswer::running);
  ++room.command.undo_serial;
  room.step(200);
  EXPECT_EQ(room.tick.split, SplitAnswer::done);
  EXPECT_EQ(room.bodies.digest(), first);
}

TEST(ToothSplit, ThereAreNoMoreThanFourPieces) {
  PartedTooth room;
  SplitPlan none;
  for (int n = 0; n < 5; ++n) {
    // One block comes off each time.
    const CarvedBone& tooth = room.bodies.bones()[1];
    std::vector<std::uint8_t> bytes = tooth.solidInGridOrder();
    SplitPlan all = splitPlan(tooth.grid(), bytes);
    all.blocks.resize(1);
    room.command.split = {room.command.split.serial + 1, room.bodies.digest(), 0, &all};
    room.step(3);
    EXPECT_EQ(room.tick.split, n < 3 ? SplitAnswer::done : SplitAnswer::refused);
    EXPECT_EQ(room.tick.pieces, std::min(n + 2, 4));
  }
}

}  // namespace
}  // namespace haptics
