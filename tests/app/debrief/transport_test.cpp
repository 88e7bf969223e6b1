#include "app/debrief/transport.h"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(Transport, PlaysAtItsSpeedAndStopsAtTheEnd) {
  Transport transport(10.0);
  transport.advance(5.0);
  EXPECT_EQ(transport.position_s(), 0.0) << "it stands at first";
  transport.playOrPause();
  transport.advance(2.0);
  EXPECT_DOUBLE_EQ(transport.position_s(), 2.0);
  transport.changeSpeed(-3);
  EXPECT_EQ(transport.speedText(), "1/8 ×");
  transport.advance(8.0);
  EXPECT_DOUBLE_EQ(transport.position_s(), 3.0);
  transport.changeSpeed(100);
  EXPECT_EQ(transport.speedText(), "8 ×");
  transport.advance(1.0);
  EXPECT_EQ(transport.position_s(), 10.0);
  EXPECT_FALSE(transport.isPlaying());
  transport.playOrPause();
  EXPECT_EQ(transport.position_s(), 0.0) << "from the beginning";
}

TEST(Transport, ASpeedThatIsAskedForIsTheNearest) {
  Transport transport(10.0);
  for (const auto& [asked, is] :
       {std::pair(0.25, 0.25), std::pair(3.0, 4.0), std::pair(0.7, 0.5), std::pair(1e9, 8.0)}) {
    transport.setSpeed(asked);
    EXPECT_EQ(transport.speed(), is) << asked;
  }
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) transport.setSpeed(none);
  EXPECT_EQ(transport.speed(), 8.0);
}

TEST(Transport, IsShuttledBothWays) {
  Transport transport(100.0);
  transport.goTo(50.0);
  transport.shuttle(1);
  EXPECT_EQ(transport.speed(), 1.0);
  transport.shuttle(1);
  transport.shuttle(1);
  EXPECT_EQ(transport.speed(), 4.0);
  transport.shuttle(-1);
  EXPECT_EQ(transport.speed(), 1.0);
  EXPECT_TRUE(transport.isBackwards());
  transport.advance(3.0);
  EXPECT_DOUBLE_EQ(transport.position_s(), 47.0);
  transport.shuttle(-1);
  transport.advance(100.0);
  EXPECT_EQ(transport.position_s(), 0.0);
  EXPECT_FALSE(transport.isPlaying());
}

TEST(Transport, GoesFromMarkToMark) {
  Transport transport(20.0);
  const std::vector<double> marks_s{2.0, 2.0, 7.5, 19.0};
  transport.goToNext(marks_s, -1);
  EXPECT_EQ(transport.position_s(), 0.0);
  for (const double wanted_s : {2.0, 7.5, 19.0, 19.0}) {
    transport.goToNext(marks_s, 1);
    EXPECT_EQ(transport.position_s(), wanted_s);
  }
  for (const double wanted_s : {7.5, 2.0, 2.0}) {
    transport.goToNext(marks_s, -1);
    EXPECT_EQ(transport.position_s(), wanted_s);
  }
}

TEST(Transport, NeverLeavesTheSession) {
  std::mt19937 random(1);
  Transport transport(12.0);
  const std::vector<double> marks_s{1.0, 4.0};
  for (int n = 0; n < 2000; ++n) {
    switch (random() % 7) {
      case 0:
        transport.playOrPause();
        break;
      case 1:
        transport.shuttle(random() % 2 == 0 ? 1 : -1);
        break;
      case 2:
        transport.changeSpeed(static_cast<int>(random() % 5) - 2);
        break;
      case 3:
        transport.jump(static_cast<double>(random() % 41) - 20.0);
        break;
      case 4:
        transport.goTo(std::numeric_limits<double>::quiet_NaN());
        break;
      case 5:
        transport.goToNext(marks_s, random() % 2 == 0 ? 1 : -1);
        break;
      default:
        transport.advance(0.3);
    }
    ASSERT_GE(transport.position_s(), 0.0);
    ASSERT_LE(transport.position_s(), 12.0);
    ASSERT_GE(transport.speed(), 0.125);
    ASSERT_LE(transport.speed(), 8.0);
  }
  transport.goTo(11.0);
  transport.setLength(5.0);
  EXPECT_EQ(transport.position_s(), 5.0);
}

}  // namespace
}  // namespace app
