#include "app/procedure/debris/chip_desk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/haptics/chipped_bone.h"

namespace app {
namespace {

/// A peg cut off, and the desk that follows.
struct Followed {
  haptics::test::ChippedBone bone;
  ChipDesk desk{bone.bodies};

  std::optional<haptics::ChipOrder> frame(bool waits = true, bool is_applied = true) {
    std::vector<glm::ivec3> bricks;
    bone.bodies.takeDirtyBricks(bricks);
    auto order = desk.follow(bricks, bone.tick, is_applied, waits);
    if (!order) return {};
    order->serial = bone.command.chips.serial + 1;
    bone.command.chips = *order;
    ++bone.command.serial;
    return order;
  }
};

TEST(ChipDesk, OrdersOnceAndTellsWhatCameLoose) {
  Followed followed;
  followed.bone.step();
  EXPECT_FALSE(followed.frame());
  followed.bone.cut();
  EXPECT_FALSE(followed.frame()) << "bricks have changed";
  ASSERT_TRUE(followed.frame());
  EXPECT_EQ(followed.desk.takeLoosened(), nullptr);
  followed.bone.step(20);
  EXPECT_FALSE(followed.frame());
  const haptics::ChipPlan* const loosened = followed.desk.takeLoosened();
  ASSERT_NE(loosened, nullptr);
  EXPECT_EQ(loosened->chips.size(), 1u);
  EXPECT_EQ(followed.desk.takeLoosened(), nullptr);
  for (int n = 0; n < 4; ++n) EXPECT_FALSE(followed.frame());
}

TEST(ChipDesk, AsksAgainAfterARefusal) {
  Followed followed;
  followed.bone.step();
  followed.frame();
  followed.bone.cut();
  followed.frame();
  ASSERT_TRUE(followed.frame());
  followed.bone.command.chips.bodies_digest ^= 1;
  followed.bone.step(5);
  ASSERT_EQ(followed.bone.tick.chips, haptics::ChipAnswer::refused);
  // A brick has to change for it to look again: any cut does.
  bool asked = false;
  for (int n = 0; n < 4 && !asked; ++n) asked = followed.frame().has_value();
  EXPECT_TRUE(asked);
}

TEST(ChipDesk, SaysNothingUntilTheCommandIsApplied) {
  Followed followed;
  followed.bone.step();
  followed.frame();
  followed.bone.cut();
  for (int n = 0; n < 4; ++n) EXPECT_FALSE(followed.frame(true, false));
  EXPECT_FALSE(followed.frame());
  EXPECT_TRUE(followed.frame());
}

TEST(ChipDesk, OfARunningServoItAnswersWhenItIsReady) {
  Followed followed;
  followed.bone.step();
  followed.frame(false);
  followed.bone.cut();
  bool asked = false;
  // As long as it takes: the test's own limit ends it if the answer never comes.
  while (!asked) {
    asked = followed.frame(false).has_value();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(asked);
}

}  // namespace
}  // namespace app
