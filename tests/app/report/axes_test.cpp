#include "app/report/axes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace app {
namespace {

TEST(AxisTicks, StepByOneTwoOrFive) {
  const AxisTicks ticks = axisTicks(0.0, 3.3, 6, true);
  EXPECT_EQ(ticks.step, 1.0);
  EXPECT_EQ(ticks.low, 0.0);
  EXPECT_EQ(ticks.high, 4.0);
  EXPECT_EQ(ticks.at.size(), 5u);
  EXPECT_NEAR(axisTicks(0.56, 1.04, 6, false).step, 0.1, 1e-12);
  EXPECT_NEAR(axisTicks(-0.2, 0.9, 6, true).low, -0.2, 1e-12);
}

TEST(AxisTicks, StayInsideARangeThatIsGiven) {
  const AxisTicks ticks = axisTicks(0.13, 1.98, 6, false);
  EXPECT_EQ(ticks.low, 0.13);
  EXPECT_EQ(ticks.high, 1.98);
  for (const double at : ticks.at) EXPECT_TRUE(at >= 0.13 && at <= 1.98) << at;
}

TEST(AxisTicks, WriteTheDigitsOfTheStep) {
  EXPECT_EQ(axisTicks(0.0, 1.0, 5, true).text(0.4), "0.4");
  EXPECT_EQ(axisTicks(0.0, 1000.0, 5, true).text(400.0), "400");
  EXPECT_EQ(axisTicks(-0.05, 0.05, 5, true).text(-0.04), "\u22120.04");
}

TEST(AxisTicks, SurviveEveryRange) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 0.0}) {
    const AxisTicks ticks = axisTicks(bad, bad, 6, true);
    EXPECT_LT(ticks.low, ticks.high);
    EXPECT_LT(ticks.at.size(), 20u);
  }
}

TEST(Axes, PlaceValuesUpwardsAndEitherWayAcross) {
  Axes axes{{10.0, 20.0}, {100.0, 50.0}, {0.0, 4.0, {}, ""}, {-1.0, 1.0, {}, ""}, ""};
  EXPECT_EQ(axes.at({1.0, 1.0}), glm::dvec2(35.0, 20.0));
  EXPECT_EQ(axes.at({4.0, -1.0}), axes.foot());
  std::swap(axes.x.from, axes.x.to);
  EXPECT_EQ(axes.at({1.0, 0.0}), glm::dvec2(85.0, 45.0));
}

TEST(Legend, BeginsANewRowWhereOneIsFull) {
  const Drawing drawing({100.0, 100.0});
  const std::vector<LegendEntry> entries(3, {"forty units", 10.0, {}});
  const double one = legend(drawing, entries, {}, 1000.0, false);
  EXPECT_EQ(legend(drawing, entries, {}, 60.0, false), 3.0 * one);
  EXPECT_EQ(legend(drawing, {}, {}, 60.0, false), 0.0);
}

}  // namespace
}  // namespace app
