#include "app/rehearsal/tooth_follower.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "haptics/bone/carve.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

/// A tooth of 10 x 5 x 6 mm that stands free in a volume.
struct FreeTooth {
  assets::VolumeGrid grid{{48, 32, 40}, 0.25, {-6.0, -4.0, -5.0}};
  std::vector<std::uint8_t> solid, label, is_tooth;

  FreeTooth() : solid(grid.voxelCount()), label(grid.voxelCount()), is_tooth(grid.voxelCount()) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = glm::abs(grid.centre_P_mm(ijk));
      if (p.x > 5.0 || p.y > 2.5 || p.z > 3.0) return;
      solid[v] = 255, label[v] = 5, is_tooth[v] = 1;
    });
  }
};

/// A slot across the tooth, from above down to `floor_mm`.
void section(haptics::Bodies& bodies, double floor_mm) {
  haptics::ErosionStep step;
  step.loss.fill(1.0);
  std::uint64_t tick = 0;
  for (double z = 3.0; z > floor_mm + 0.7; z -= 0.25)
    for (double y = -3.5; y < 3.6; y += 0.2)
      for (int n = 0; n < 3; ++n)
        haptics::carveTool(bodies, {haptics::ShapeKind::sphere, 0.7, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {0.1, y, z}}, step,
                           ++tick);
}

TEST(ToothFollower, TellsTheBridgeThenThePieces) {
  const FreeTooth tooth;
  haptics::Bodies bodies(tooth.grid, tooth.solid, tooth.label, tooth.is_tooth);
  ToothFollower follower(bodies);
  EXPECT_EQ(follower.ending(), "");
  EXPECT_FALSE(follower.news());

  section(bodies, -1.2);
  EXPECT_EQ(follower.ending().rfind("held by a bridge of ", 0), 0u) << follower.ending();
  const auto bridge = follower.news();
  ASSERT_TRUE(bridge);
  EXPECT_EQ(bridge->rfind("the tooth is held by a bridge of ", 0), 0u) << *bridge;
  EXPECT_FALSE(follower.news()) << "told once";

  section(bodies, -4.0);
  EXPECT_EQ(follower.ending().rfind("in 2 pieces, 1", 0), 0u) << follower.ending();
  const auto apart = follower.news();
  ASSERT_TRUE(apart);
  EXPECT_EQ(apart->rfind("the tooth is in 2 pieces, ", 0), 0u) << *apart;
}

TEST(ToothFollower, ATimeLaterTheWholeToothIsRemembered) {
  const FreeTooth tooth;
  haptics::Bodies bodies(tooth.grid, tooth.solid, tooth.label, tooth.is_tooth);
  const std::vector<std::uint8_t> whole = bodies.bones()[1].solidInGridOrder();
  section(bodies, -1.2);
  ToothFollower follower(bodies, whole);
  EXPECT_EQ(follower.ending().rfind("held by a bridge of ", 0), 0u) << follower.ending();
}

/// A servo over a tooth, with a tool that is clear of it.
struct FollowedTooth {
  FreeTooth tooth;
  haptics::Bodies bodies{tooth.grid, tooth.solid, tooth.label, tooth.is_tooth};
  haptics::Servo servo{bodies};
  ToothFollower follower{bodies};
  haptics::Command command;
  haptics::HandSample hand;
  haptics::Tick tick;

  FollowedTooth() { hand.X_PT.translation_mm = {0.0, 0.0, 30.0}; }
  void step(int ticks = 1) {
    for (int n = 0; n < ticks; ++n) tick = servo.step(hand, command, 1e-3);
  }
  std::vector<glm::ivec3> dirty() {
    std::vector<glm::ivec3> bricks;
    bodies.takeDirtyBricks(bricks);
    return bricks;
  }
  /// What a rehearsal does in frames until all is quiet. True: an order was given.
  bool frame() {
    follower.follow(dirty(), tick, true);
    follower.follow(dirty(), tick, true);
    const auto order = follower.order(tick);
    if (order) {
      const std::uint64_t serial = command.split.serial + 1;
      command.split = *order;
      command.split.serial = serial;
    }
    step(100);
    return order.has_value();
  }
};

TEST(ToothFollower, OrdersASplitOnceForEveryPieceThatFallsOff) {
  FollowedTooth room;
  room.step();
  EXPECT_FALSE(room.frame());
  section(room.bodies, -1.2);
  room.step();
  EXPECT_FALSE(room.frame()) << "held by a bridge";
  section(room.bodies, -4.0);
  room.step();
  EXPECT_TRUE(room.frame());
  EXPECT_EQ(room.tick.split, haptics::SplitAnswer::done);
  EXPECT_EQ(room.tick.pieces, 2);
  const auto line = room.follower.news();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->rfind("the tooth is in 2 pieces, 1", 0), 0u) << *line;
  EXPECT_FALSE(room.frame());
  EXPECT_FALSE(room.follower.news()) << "told once";

  // A piece falls apart again, and is sectioned as the tooth was.
  haptics::ErosionStep step;
  step.loss.fill(1.0);
  std::uint64_t tick = 1000;
  for (double z = 3.0; z > -4.0; z -= 0.25)
    for (double x = 0.0; x < 6.0; x += 0.2)
      for (int n = 0; n < 3; ++n)
        haptics::carveTool(room.bodies, {haptics::ShapeKind::sphere, 0.7, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {x, 0.2, z}},
                           step, ++tick);
  room.step();
  EXPECT_TRUE(room.frame());
  EXPECT_EQ(room.tick.pieces, 3);
  EXPECT_EQ(room.follower.ending().rfind("in 3 pieces, ", 0), 0u) << room.follower.ending();
}

/// A bur that turns in the slot grazes voxels: they remember it, and no solid is gone.
TEST(ToothFollower, AsksAgainWhenAnOrderCameTooEarly) {
  FollowedTooth room;
  section(room.bodies, -4.0);
  room.step();
  room.follower.follow(room.dirty(), room.tick, true);
  room.follower.follow(room.dirty(), room.tick, true);
  auto order = room.follower.order(room.tick);
  ASSERT_TRUE(order);
  haptics::ErosionStep graze;
  graze.loss.fill(1e-4);
  haptics::carveTool(room.bodies, {haptics::ShapeKind::sphere, 0.7, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {0.75, 0.0, 1.0}},
                     graze, 5000);
  order->serial = 1;
  room.command.split = *order;
  room.step();
  ASSERT_EQ(room.tick.split, haptics::SplitAnswer::refused);
  EXPECT_TRUE(room.frame());
  EXPECT_EQ(room.tick.split, haptics::SplitAnswer::done);
}

TEST(ToothFollower, ArmsTheBridgeWhileForcepsAreInTheHand) {
  FollowedTooth room;
  section(room.bodies, -1.2);
  room.step();
  const auto frame = [&](bool in_hand) {
    room.follower.follow(room.dirty(), room.tick, true);
    room.follower.follow(room.dirty(), room.tick, true);
    auto order = room.follower.bridgeOrder(room.tick, in_hand, true);
    if (order) {
      order->serial = room.command.bridge.serial + 1;
      room.command.bridge = *order;
    }
    room.step(20);
    return order.has_value();
  };
  EXPECT_FALSE(frame(false));
  while (room.follower.news()) {
  }
  ASSERT_TRUE(frame(true));
  EXPECT_EQ(room.tick.bridge, haptics::BreakAnswer::armed);
  const auto line = room.follower.news();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->rfind("the bridge of ", 0), 0u) << *line;
  EXPECT_NE(line->find(" breaks at about "), std::string::npos) << *line;
  EXPECT_FALSE(frame(true)) << "once";
  // Cut on, the plan is of another tooth.
  section(room.bodies, -1.6);
  room.step();
  EXPECT_EQ(room.tick.bridge, haptics::BreakAnswer::outdated);
  EXPECT_TRUE(frame(true));
  EXPECT_EQ(room.tick.bridge, haptics::BreakAnswer::armed);
}

TEST(ToothFollower, ArmsAgainWhatCameTooEarly) {
  FollowedTooth room;
  section(room.bodies, -1.2);
  room.step();
  const auto look = [&] {
    room.follower.follow(room.dirty(), room.tick, true);
    room.follower.follow(room.dirty(), room.tick, true);
    return room.follower.bridgeOrder(room.tick, true, true);
  };
  auto order = look();
  ASSERT_TRUE(order);
  order->serial = 1;
  order->bodies_digest ^= 1;
  room.command.bridge = *order;
  room.step();
  ASSERT_EQ(room.tick.bridge, haptics::BreakAnswer::refused);
  order = look();
  ASSERT_TRUE(order);
  order->serial = 2;
  room.command.bridge = *order;
  room.step();
  EXPECT_EQ(room.tick.bridge, haptics::BreakAnswer::armed);
  EXPECT_FALSE(look());
}

TEST(ToothFollower, OrdersNothingWhileBricksChange) {
  FollowedTooth room;
  section(room.bodies, -4.0);
  room.step();
  room.follower.follow(room.dirty(), room.tick, false);
  EXPECT_FALSE(room.follower.order(room.tick));
  room.follower.follow({}, room.tick, false);
  // The look is on another thread.
  std::optional<haptics::SplitOrder> order;
  for (int n = 0; n < 2000 && !order; ++n) {
    order = room.follower.order(room.tick);
    if (!order) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(order);
  EXPECT_EQ(order->bodies_digest, room.bodies.digest());
}

TEST(ToothFollower, SaysNothingOfAJawWithoutTooth) {
  const FreeTooth tooth;
  haptics::Bodies bodies(tooth.grid, tooth.solid, tooth.label);
  ToothFollower follower(bodies);
  follower.follow(std::vector<glm::ivec3>{{0, 0, 0}}, haptics::Tick{}, false);
  follower.follow({}, haptics::Tick{}, true);
  EXPECT_FALSE(follower.order(haptics::Tick{}));
  EXPECT_FALSE(follower.news());
  EXPECT_EQ(follower.ending(), "");
}

}  // namespace
}  // namespace app
