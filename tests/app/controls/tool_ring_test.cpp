#include "app/controls/tool_ring.h"

#include <gtest/gtest.h>

#include "app/view/ring_shape.h"

namespace app {
namespace {

const glm::dvec2 kMiddle(0.8, 0.5);

ToolRing opened(std::size_t tools, std::size_t in_hand = 0) {
  ToolRing ring;
  ring.open(tools, in_hand, kMiddle);
  return ring;
}

TEST(ToolRing, TheDirectionOfTheHandChooses) {
  ToolRing ring = opened(4);
  const auto towards = [&](double x, double y) {
    ring.moveTo(kMiddle + glm::dvec2(x, y));
    return ring.chosen();
  };
  EXPECT_EQ(towards(0.0, -0.1), 0u) << "up";
  EXPECT_EQ(towards(0.1, 0.0), 1u) << "right";
  EXPECT_EQ(towards(0.0, 0.1), 2u) << "down";
  EXPECT_EQ(towards(-0.1, 0.0), 3u) << "left";
  EXPECT_EQ(towards(-0.1, -0.11), 0u) << "nearer to up than to left";
  EXPECT_EQ(towards(-0.11, -0.1), 3u);
  EXPECT_EQ(towards(0.0, -5.0), 0u) << "far away as near";
}

TEST(ToolRing, NothingIsChosenInTheMiddle) {
  ToolRing ring = opened(5);
  EXPECT_FALSE(ring.chosen());
  ring.moveTo(kMiddle + glm::dvec2(0.99 * kRingMiddle, 0.0));
  EXPECT_FALSE(ring.chosen());
  ring.moveTo(kMiddle + glm::dvec2(1.01 * kRingMiddle, 0.0));
  EXPECT_TRUE(ring.chosen());
  ring.moveTo(kMiddle);
  EXPECT_FALSE(ring.chosen()) << "and back again";
  EXPECT_FALSE(ring.take());
  EXPECT_FALSE(ring.isOpen());
}

TEST(ToolRing, EveryInstrumentOfAnyTrayIsReachedWhereItIsDrawn) {
  for (std::size_t tools = 1; tools <= kMostInRing; ++tools)
    for (std::size_t n = 0; n < tools; ++n) {
      ToolRing ring = opened(tools, (n + 1) % tools);
      ring.moveTo(kMiddle + 0.1 * ringDirection(n, tools));
      EXPECT_EQ(ring.chosen(), n) << tools;
      EXPECT_EQ(ring.take(), tools == 1 ? std::nullopt : std::optional(n));
    }
}

TEST(ToolRing, SectorsOfNineInstrumentsMeetHalfWay) {
  ToolRing ring = opened(9, 8);
  for (std::size_t n = 0; n < 9; ++n) {
    const glm::dvec2 between = ringDirection(2 * n + 1, 18), aside(-between.y, between.x);
    ring.moveTo(kMiddle + 0.1 * between - 0.001 * aside);
    EXPECT_EQ(ring.chosen(), n);
    ring.moveTo(kMiddle + 0.1 * between + 0.001 * aside);
    EXPECT_EQ(ring.chosen(), (n + 1) % 9);
  }
}

TEST(ToolRing, WhatIsInTheHandIsNotTakenAgain) {
  ToolRing ring = opened(3, 0);
  ring.moveTo(kMiddle + glm::dvec2(0.0, -0.1));
  EXPECT_EQ(ring.chosen(), 0u);
  EXPECT_FALSE(ring.take());
}

TEST(ToolRing, CancelledOrClosedItChoosesNothing) {
  ToolRing ring = opened(3);
  ring.moveTo(kMiddle + glm::dvec2(0.1, 0.0));
  ring.cancel();
  EXPECT_FALSE(ring.isOpen());
  EXPECT_FALSE(ring.chosen());
  ring.moveTo(kMiddle + glm::dvec2(0.1, 0.0));
  EXPECT_FALSE(ring.chosen());
  ring.open(2, 0, kMiddle);
  EXPECT_FALSE(ring.chosen()) << "it begins anew";
}

TEST(ToolRing, PlacesThatAreNoNumbersChooseNothing) {
  ToolRing ring = opened(3);
  ring.moveTo({std::nan(""), 0.0});
  EXPECT_FALSE(ring.chosen());
}

}  // namespace
}  // namespace app
