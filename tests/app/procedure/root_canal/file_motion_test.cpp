// Motions of a file by name: a scripted hand does each as it is taught.
#include "app/procedure/root_canal/file_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace app {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kTick_s = 0.001;

/// Turns and slides at steady rates, tick by tick.
class Hand {
 public:
  MotionNames names;

  void move(double seconds, double turn_deg, double in_mm) {
    const int ticks = static_cast<int>(std::lround(seconds / kTick_s));
    const double from_rad = roll_rad_, from_mm = in_mm_;
    for (int n = 1; n <= ticks; ++n) {
      const double share = static_cast<double>(n) / ticks;
      roll_rad_ = from_rad + share * turn_deg * kDegree;
      in_mm_ = from_mm + share * in_mm;
      names.add(kTick_s, roll_rad_, in_mm_);
    }
    all_s_ += seconds;
  }
  void offTheWall(double turn_deg) {
    names.lift();
    roll_rad_ += turn_deg * kDegree;
  }
  double share(FileMotion motion) const { return names.seconds(motion) / all_s_; }
  double all_s() const { return all_s_; }
  double told_s() const {
    double sum = names.other_s();
    for (std::size_t n = 0; n < kFileMotions; ++n) sum += names.seconds(FileMotion{n});
    return sum;
  }

 private:
  double roll_rad_ = 0.3, in_mm_ = -4.0, all_s_ = 0.0;
};

TEST(FileMotion, PushAndPullIsFiling) {
  Hand hand;
  for (int n = 0; n < 10; ++n) hand.move(0.25, 2.0, -2.0), hand.move(0.25, -2.0, 2.0);
  EXPECT_NEAR(hand.share(FileMotion::filing), 1.0, 0.01);
  EXPECT_EQ(hand.names.now(), FileMotion::filing);
}

TEST(FileMotion, ToAndFroIsWatchWinding) {
  for (const double angle_deg : {30.0, 45.0, 60.0}) {
    Hand hand;
    hand.move(0.2, angle_deg, 0.05);
    for (int n = 0; n < 10; ++n) hand.move(0.35, -2.0 * angle_deg, 0.1), hand.move(0.35, 2.0 * angle_deg, 0.1);
    hand.offTheWall(0.0);
    EXPECT_GT(hand.share(FileMotion::watch_winding), 0.95) << angle_deg;
  }
}

TEST(FileMotion, AQuarterTurnAndOutIsReaming) {
  Hand hand;
  for (int n = 0; n < 8; ++n) {
    hand.move(0.5, 120.0, 0.1);
    hand.move(0.5, 0.0, -3.0);
    hand.offTheWall(-120.0);
  }
  EXPECT_GT(hand.share(FileMotion::reaming), 0.95);
  EXPECT_EQ(hand.names.seconds(FileMotion::filing), 0.0) << "drawing out belongs to it";
}

TEST(FileMotion, BackByMoreThanWindingIsBalancedForce) {
  for (const double cw_deg : {60.0, 90.0, 170.0}) {
    Hand hand;
    for (int n = 0; n < 8; ++n) hand.move(0.8, cw_deg, 0.05), hand.move(1.0, -180.0, 0.1);
    hand.offTheWall(0.0);
    EXPECT_GT(hand.share(FileMotion::balanced_force), 0.95) << cw_deg;
  }
}

TEST(FileMotion, WhatIsHeldStillHasNoName) {
  Hand hand;
  hand.move(3.0, 4.0, 0.1);
  hand.offTheWall(0.0);
  EXPECT_FALSE(hand.names.now());
  EXPECT_NEAR(hand.names.other_s(), 3.0, 1e-9);
}

/// Whatever a hand does, every tick is told once.
TEST(FileMotion, TheTimesAddUp) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int run = 0; run < 50; ++run) {
    Hand hand;
    for (int n = 0; n < 40; ++n) {
      hand.move(0.05 + 0.45 * std::fabs(share(random)), 200.0 * share(random), 3.0 * share(random));
      if (share(random) > 0.8) hand.offTheWall(90.0);
    }
    hand.offTheWall(0.0);
    EXPECT_NEAR(hand.told_s(), hand.all_s(), 0.05) << "run " << run;
  }
}

}  // namespace
}  // namespace app
