#include <gtest/gtest.h>

#include "haptics/body/piece_split.h"
#include "haptics/latest.h"
#include "haptics/servo/tick_log.h"
#include "tests/app/session/real_session.h"
#include "tests/architecture/forbid_blocking.h"

namespace tests {
namespace {

TEST(ServoRealTime, NeitherAllocatesNorBlocksInTenThousandTicksOfCarving) {
  if (ForbidBlocking::countsNothing()) GTEST_SKIP() << "a sanitizer owns malloc: nothing can be counted";
  const app::test::BoneBlock block;
  haptics::Bodies bone(block.grid, block.solid, block.label);
  haptics::Servo servo(bone);
  haptics::TickLog log(1000);
  haptics::Latest<haptics::Command> commands(block.start().command);
  haptics::Latest<haptics::Tick> newest;

  double removed_mm3 = 0.0;
  std::uint64_t in_contact = 0, faulty = 0;
  const ForbidBlocking guard;
  for (int n = 0; n < 10'000; ++n) {
    haptics::HandSample hand = app::test::sweepingHand(n * 0.001);
    // Deeper and deeper, now and then far away, in the middle of the bone, or nowhere at all.
    hand.X_PT.translation_mm.z -= n * 3e-4;
    if (n % 997 == 0) hand.X_PT.translation_mm.z = 100.0;
    if (n % 1499 == 0) hand.X_PT.translation_mm = {0.0, 0.0, -2.5};
    if (n % 1999 == 0) hand.X_PT.translation_mm.x = std::nan("");
    if (n % 500 == 0) {
      haptics::Command command = block.start().command;
      command.serial = 1 + static_cast<std::uint64_t>(n / 500);
      // Every law with every head, with and without a shaft.
      command.law.kind = haptics::kLaws[static_cast<std::size_t>(n / 500) % haptics::kLaws.size()].kind;
      command.tool.head = {static_cast<haptics::ShapeKind>(n / 500 % haptics::kShapeKinds), 0.5 + 0.2 * (n / 500 % 8),
                           1.5, static_cast<assets::BurProfile>(n / 2500 % 9)};
      if (n / 500 % 3 != 0) command.tool.shaft = {0.5, 9.0};
      commands.publish(command);
    }
    const haptics::Tick tick = servo.step(hand, commands.read(), 0.001);
    log.push(tick);
    newest.publish(tick);
    removed_mm3 += tick.removed_mm3;
    in_contact += tick.overlap_mm3 > 0.0 ? 1 : 0;
    faulty += tick.faults != haptics::Fault::none ? 1 : 0;
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.blockingCalls(), 0u);
  // The ticks did what they are guarded for.
  EXPECT_GT(in_contact, 5'000u);
  EXPECT_GT(removed_mm3, 1.0);
  EXPECT_GT(faulty, 0u);
}

/// The tooth is one half of the block, moved a little off the jaw, and the bur goes to and fro across both.
TEST(ServoRealTime, NeitherAllocatesNorBlocksWhileTheBurCutsAJawAndAMovedTooth) {
  if (ForbidBlocking::countsNothing()) GTEST_SKIP() << "a sanitizer owns malloc: nothing can be counted";
  const app::test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.grid.voxelCount());
  assets::forVoxels(block.grid,
                    [&](glm::ivec3 ijk, std::size_t v) { is_tooth[v] = block.grid.centre_P_mm(ijk).x > 0.1; });
  haptics::Bodies bodies(block.grid, block.solid, block.label, is_tooth);
  ASSERT_EQ(bodies.pieces(), 1u);
  haptics::Bodies::PiecePose moved;
  moved.rotation = glm::angleAxis(0.03, glm::dvec3(0.0, 1.0, 0.0));
  moved.translation_mm = {0.15, 0.1, 0.05};
  bodies.place(0, moved);
  ASSERT_FALSE(bodies.isAtRest(0));
  haptics::Servo servo(bodies);
  const auto removed_mm3 = [](const haptics::CarvedBone& bone) {
    double sum_mm3 = 0.0;
    for (const double one_mm3 : bone.removedByTissue_mm3()) sum_mm3 += one_mm3;
    return sum_mm3;
  };

  haptics::Command command = block.start().command;
  std::uint64_t in_contact = 0;
  const ForbidBlocking guard;
  for (int n = 0; n < 6'000; ++n) {
    haptics::HandSample hand = app::test::sweepingHand(n * 0.001);
    hand.X_PT.translation_mm.z -= n * 3e-4;
    if (n % 300 == 0) {
      const int change = n / 300;
      ++command.serial;
      command.law.kind = haptics::kLaws[static_cast<std::size_t>(change) % haptics::kLaws.size()].kind;
      command.tool.head = {static_cast<haptics::ShapeKind>(change % haptics::kShapeKinds), 0.5 + 0.2 * (change % 8),
                           1.5, static_cast<assets::BurProfile>(change / 5 % 9)};
    }
    in_contact += servo.step(hand, command, 0.001).overlap_mm3 > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.blockingCalls(), 0u);
  EXPECT_GT(in_contact, 3'000u);
  EXPECT_GT(removed_mm3(bodies.bones()[0]), 0.5);
  EXPECT_GT(removed_mm3(bodies.bones()[1]), 0.5);
}

/// It moves from one piece to the other in many ticks.
TEST(ServoRealTime, NeitherAllocatesNorBlocksWhileAToothIsSplit) {
  if (ForbidBlocking::countsNothing()) GTEST_SKIP() << "a sanitizer owns malloc: nothing can be counted";
  const app::test::BoneBlock block;
  std::vector<std::uint8_t> is_tooth(block.grid.voxelCount()), solid = block.solid;
  assets::forVoxels(block.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double x_mm = block.grid.centre_P_mm(ijk).x;
    is_tooth[v] = std::abs(x_mm) < 3.0;
    if (std::abs(x_mm) < 0.3) solid[v] = 0;
  });
  haptics::Bodies bodies(block.grid, solid, block.label, is_tooth);
  haptics::Servo servo(bodies);
  haptics::Command command = block.start().command;
  haptics::HandSample hand;
  hand.X_PT.translation_mm = {0.0, 0.0, 100.0};
  const haptics::CarvedBone& tooth = bodies.bones()[1];
  const haptics::SplitPlan plan = haptics::partingPlan({tooth.grid(), tooth.solidInGridOrder()});
  ASSERT_FALSE(plan.blocks.empty());
  haptics::Tick tick;
  const ForbidBlocking guard;
  command.split = {1, bodies.digest(), 0, &plan};
  for (int n = 0; n < 400; ++n) tick = servo.step(hand, command, 0.001);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.blockingCalls(), 0u);
  EXPECT_EQ(tick.split, haptics::SplitAnswer::done);
  EXPECT_EQ(tick.pieces, 2);
}

}  // namespace
}  // namespace tests
