#include "haptics/safety/hand_guard.h"

#include <gtest/gtest.h>

#include <limits>

namespace haptics {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

HandSample at(double x_mm) {
  HandSample hand;
  hand.X_PT.translation_mm.x = x_mm;
  hand.drill_pedal = true;
  hand.velocity_P_mm_per_s.xyz.x = hand.handle_velocity_P_mm_per_s.xyz.x = 5.0;
  return hand;
}

TEST(HandGuard, BelievesTwoMetresASecondAtEveryRateAndNoMore) {
  for (double rate_Hz : {500.0, 1000.0, 4000.0, 10'000.0}) {
    const double dt_s = 1.0 / rate_Hz;
    HandGuard guard;
    guard.check(at(0.0), strict({}), dt_s);
    double x = 0.0;
    for (int tick = 0; tick < 200; ++tick) {
      x += 1999.0 * dt_s;
      ASSERT_FALSE(guard.check(at(x), strict({}), dt_s).refused) << rate_Hz;
    }
    EXPECT_TRUE(guard.check(at(x + 2001.0 * dt_s), strict({}), dt_s).refused) << rate_Hz;
  }
}

TEST(HandGuard, HoldsTheLastPoseAtRestAndHalvesTheForceOnABadSample) {
  HandSample nowhere = at(1.0), far = at(1000.0), turned = at(1.0), flat = at(1.0), blind = at(1.0);
  nowhere.X_PT.translation_mm.y = kNan;
  nowhere.velocity_P_mm_per_s.xyz.z = kNan;
  turned.X_PT.rotation = glm::dquat(std::cos(0.06), std::sin(0.06), 0.0, 0.0);  // 0.12 rad in a millisecond
  flat.X_PT.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0);
  blind.jacobian_P_mm[2].x = kNan;
  for (const HandSample& bad : {nowhere, far, turned, flat, blind}) {
    HandGuard guard;
    guard.check(at(1.0), strict({}), 1e-3);
    HandGuard::Checked checked = guard.check(bad, strict({}), 1e-3);
    EXPECT_TRUE(checked.refused);
    EXPECT_FALSE(checked.lost);
    EXPECT_EQ(checked.confidence, 0.5);
    EXPECT_EQ(checked.hand.X_PT.translation_mm, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(checked.hand.velocity_P_mm_per_s.xyz, glm::dvec3(0.0));
    EXPECT_EQ(checked.hand.handle_velocity_P_mm_per_s.xyz, glm::dvec3(0.0));
    EXPECT_FALSE(checked.hand.drill_pedal);
    checked = guard.check(at(1.0), strict({}), 1e-3);
    EXPECT_FALSE(checked.refused);
    EXPECT_EQ(checked.confidence, 1.0);
  }
}

TEST(HandGuard, GivesUpAfterThreeInARowAndBeginsAnewWithTheNextGoodOne) {
  HandGuard guard;
  guard.check(at(0.0), strict({}), 1e-3);
  EXPECT_FALSE(guard.check(at(kNan), strict({}), 1e-3).lost);
  EXPECT_EQ(guard.check(at(kNan), strict({}), 1e-3).confidence, 0.25);
  HandGuard::Checked checked = guard.check(at(kNan), strict({}), 1e-3);
  EXPECT_TRUE(checked.lost);
  EXPECT_EQ(checked.confidence, 0.0);
  checked = guard.check(at(3.0), strict({}), 1e-3);
  EXPECT_FALSE(checked.lost || checked.refused);
  EXPECT_TRUE(checked.relocated);
}

TEST(HandGuard, DoesNotCountGoodSamplesBetweenBadOnes) {
  HandGuard guard;
  guard.check(at(0.0), strict({}), 1e-3);
  for (int tick = 0; tick < 300; ++tick)
    EXPECT_FALSE(guard.check(tick % 3 == 2 ? at(0.0) : at(kNan), strict({}), 1e-3).lost) << tick;
}

TEST(HandGuard, KeepsThePoseWhenNothingNewWasMeasured) {
  HandGuard guard;
  HandSample stale = at(7.0);
  stale.fresh = false;
  EXPECT_TRUE(guard.check(stale, strict({}), 1e-3).refused) << "of nothing nothing is known";
  guard.check(at(1.0), strict({}), 1e-3);
  stale.docked = stale.stop_requested = true;
  for (int tick = 0; tick < 10; ++tick) {
    const HandGuard::Checked checked = guard.check(stale, strict({}), 1e-3);
    EXPECT_FALSE(checked.refused || checked.lost);
    EXPECT_EQ(checked.hand.X_PT.translation_mm.x, 1.0);
    EXPECT_TRUE(checked.hand.docked && checked.hand.stop_requested);
  }
  // Ten ticks at up to 2 m/s: 20 mm are believed, and not more.
  EXPECT_FALSE(HandGuard(guard).check(at(21.0), strict({}), 1e-3).refused);
  EXPECT_TRUE(HandGuard(guard).check(at(24.0), strict({}), 1e-3).refused);
}

TEST(HandGuard, BeginsAnewAfterAPauseOfMoreThanTwentyMilliseconds) {
  for (double gap_s : {0.019, 0.021}) {
    HandGuard guard;
    guard.check(at(0.0), strict({}), 1e-3);
    HandSample later = at(900.0);
    later.gap_s = gap_s;
    const HandGuard::Checked checked = guard.check(later, strict({}), 1e-3);
    EXPECT_EQ(checked.refused, gap_s < 0.02);
    EXPECT_EQ(checked.resumed, gap_s > 0.02);
    EXPECT_EQ(checked.relocated, gap_s > 0.02);
  }
  HandGuard guard;
  HandSample mad = at(0.0);
  mad.gap_s = kNan;
  EXPECT_FALSE(guard.check(mad, strict({}), 1e-3).resumed);
}

TEST(HandGuard, MeasuresTheHandleAndNotTheTipAtTheEndOfALever) {
  // 40 mm of lever turned by 0.09 rad: the tip moves 3.6 mm, the handle stays.
  HandGuard guard;
  HandSample before = at(0.0), after = at(0.0);
  before.arm_P_mm.xyz = {0.0, 0.0, 40.0};
  before.X_PT.translation_mm = {0.0, 0.0, -40.0};
  after.arm_P_mm.xyz = glm::dvec3(40.0 * std::sin(0.09), 0.0, 40.0 * std::cos(0.09));
  after.X_PT.translation_mm = -after.arm_P_mm.xyz;
  after.X_PT.rotation = glm::dquat(std::cos(0.045), 0.0, std::sin(0.045), 0.0);
  guard.check(before, strict({}), 1e-3);
  EXPECT_FALSE(guard.check(after, strict({}), 1e-3).refused);
}

}  // namespace
}  // namespace haptics
