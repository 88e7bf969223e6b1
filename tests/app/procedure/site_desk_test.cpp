#include "app/procedure/site_desk.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "haptics/body/piece_split.h"
#include "haptics/bone/carve.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

/// A tooth of 6 x 6 x 6 mm in a hole of a block of bone, and a servo with forceps far from it.
struct Socket {
  assets::VolumeGrid grid{{48, 48, 48}, 0.25, {-6.0, -6.0, -6.0}};
  std::vector<std::uint8_t> solid, label, is_tooth;
  std::optional<haptics::Bodies> bodies;
  std::optional<SiteDesk> desk;
  std::optional<haptics::Servo> servo;
  haptics::Command command;
  haptics::HandSample hand;
  haptics::Tick tick;

  Socket() : solid(grid.voxelCount()), label(grid.voxelCount(), 1), is_tooth(grid.voxelCount()) {
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = glm::abs(grid.centre_P_mm(ijk));
      const double out_mm = std::max({p.x, p.y, p.z}) - 3.0;
      solid[v] = out_mm < 0.0 || (out_mm > 0.3 && out_mm < 2.0) ? 255 : 0;
      if (out_mm < 0.0) is_tooth[v] = 1, label[v] = 5;
    });
    bodies.emplace(grid, solid, label, is_tooth);
    desk.emplace(*bodies);
    servo.emplace(*bodies);
    command.tool = haptics::forcepsTool();
    hand.X_PT.translation_mm = {0.0, 0.0, 30.0};
    step();
  }
  void step() { tick = servo->step(hand, command, 1e-3); }
  /// One frame. True: an order was given.
  bool frame(bool gripping_tool = true) {
    const auto order = desk->follow(tick, gripping_tool, true);
    if (order) {
      const std::uint64_t serial = command.site.serial + 1;
      command.site = *order;
      command.site.serial = serial;
    }
    step();
    return order.has_value();
  }
};

TEST(SiteDesk, MakesThePieceReadyOnceWhileForcepsAreInTheHand) {
  Socket socket;
  for (int n = 0; n < 4; ++n) EXPECT_FALSE(socket.frame(false));
  EXPECT_FALSE(socket.desk->isReady());
  EXPECT_TRUE(socket.frame());
  EXPECT_EQ(socket.tick.site, haptics::SiteAnswer::ready);
  EXPECT_FALSE(socket.frame());
  EXPECT_TRUE(socket.desk->isReady());
  // A little less than 216: bone and tooth share the voxels where they meet.
  double steps = 0.0;
  for (const std::uint8_t byte : socket.bodies->bones()[1].solidInGridOrder()) steps += byte;
  EXPECT_NEAR(socket.desk->volume_mm3(0), steps / 255.0 * socket.grid.voxelVolume_mm3(), 1e-9);
  for (int n = 0; n < 4; ++n) EXPECT_FALSE(socket.frame());
}

TEST(SiteDesk, MakesItReadyAnewWhenBoneHasChangedAndLiesStill) {
  Socket socket;
  while (!socket.desk->isReady()) socket.frame();
  haptics::ErosionStep step;
  step.loss.fill(1.0);
  haptics::carveTool(*socket.bodies, {haptics::ShapeKind::sphere, 1.0, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}},
                     step, 1);
  socket.step();
  EXPECT_FALSE(socket.frame()) << "it may still change";
  EXPECT_FALSE(socket.desk->isReady());
  EXPECT_TRUE(socket.frame());
  EXPECT_EQ(socket.tick.site, haptics::SiteAnswer::ready);
  socket.frame();
  EXPECT_TRUE(socket.desk->isReady());
}

TEST(SiteDesk, AsksAgainAfterARefusal) {
  Socket socket;
  socket.frame(false);
  ASSERT_FALSE(socket.desk->isReady());
  auto order = socket.desk->follow(socket.tick, true, true);
  ASSERT_TRUE(order);
  order->bodies_digest ^= 1;
  order->serial = 1;
  socket.command.site = *order;
  socket.step();
  ASSERT_EQ(socket.tick.site, haptics::SiteAnswer::refused);
  for (int n = 0; n < 4 && !socket.desk->isReady(); ++n) socket.frame();
  EXPECT_TRUE(socket.desk->isReady());
  EXPECT_EQ(socket.tick.site, haptics::SiteAnswer::ready);
}

/// A tooth of two pieces, one of which got its site before bone was cut, and the cut is undone.
TEST(SiteDesk, OrdersAllSitesAgainForBodiesThatAnUndoBroughtBack) {
  Socket socket;
  haptics::SplitPlan plan = haptics::splitPlan(socket.bodies->bones()[1].grid(), [&] {
    std::vector<std::uint8_t> half = socket.bodies->bones()[1].solidInGridOrder();
    std::fill(half.begin(), half.begin() + static_cast<std::ptrdiff_t>(half.size() / 2), std::uint8_t{0});
    return half;
  }());
  socket.command.split = {1, socket.bodies->digest(), 0, &plan};
  for (int n = 0; n < 100; ++n) socket.step();
  ASSERT_EQ(socket.tick.pieces, 2);
  socket.frame(false);
  EXPECT_TRUE(socket.frame()) << "the first of two";
  const haptics::Tick before = socket.tick;
  // As if something was cut and undone.
  haptics::Tick other = before;
  other.bone_digest ^= 1;
  EXPECT_FALSE(socket.desk->follow(other, true, true));
  EXPECT_FALSE(socket.desk->follow(before, true, true));
  int orders = 0;
  for (int n = 0; n < 5; ++n) orders += socket.frame() ? 1 : 0;
  EXPECT_EQ(orders, 2);
  EXPECT_TRUE(socket.desk->isReady());
}

/// Of a running servo nothing waits: the site comes some frames later.
TEST(SiteDesk, DoesNotWaitForARunningServo) {
  Socket socket;
  std::optional<haptics::SiteOrder> order;
  for (int n = 0; n < 3000 && !order; ++n) {
    order = socket.desk->follow(socket.tick, true, false);
    EXPECT_FALSE(n < 2 && order) << n;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(order);
  EXPECT_EQ(order->bodies_digest, socket.bodies->digest());
  EXPECT_NE(order->site, nullptr);
}

}  // namespace
}  // namespace app
