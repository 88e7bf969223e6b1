// The small stages, each against its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "haptics/safety/buzz_detector.h"
#include "haptics/safety/joint_torques.h"
#include "haptics/safety/soft_start.h"
#include "haptics/safety/staleness.h"
#include "haptics/safety/thermal_budget.h"
#include "haptics/safety/velocity_guard.h"

namespace haptics {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kRates_Hz[] = {500.0, 1000.0, 10'000.0};

TEST(SoftStart, TakesHalfASecondAndNeverMoreThanFiveNewtonsASecond) {
  for (double rate_Hz : kRates_Hz)
    for (double peak_N : {1.0, 2.5, 3.3, 8.0}) {
      SafetyLimits limits = strict({});
      limits.peak_force_N = peak_N;
      SoftStart start;
      const double whole_s = std::max(0.5, peak_N / 5.0);
      const int ticks = static_cast<int>(std::lround(rate_Hz * whole_s));
      double last = 0.0;
      for (int tick = 1; tick <= ticks; ++tick) {
        const double share = start.update(true, false, limits, 1.0 / rate_Hz);
        ASSERT_NEAR(share, tick / (rate_Hz * whole_s), 1e-9);
        ASSERT_LE((share - last) * peak_N * rate_Hz, 5.0 + 1e-6);
        last = share;
      }
      EXPECT_NEAR(last, 1.0, 1e-9);
      for (int tick = 1; tick <= static_cast<int>(0.05 * rate_Hz + 0.5); ++tick)
        last = start.update(true, true, limits, 1.0 / rate_Hz);
      EXPECT_NEAR(last, 0.0, 1e-9) << "the deadman: 50 ms";
      start.update(true, false, limits, 0.3);
      EXPECT_EQ(start.update(false, false, limits, 1e-3), 0.0);
    }
  EXPECT_EQ(SoftStart().update(true, false, {}, 1e-3), 1.0) << "nobody to be pushed";
}

TEST(Staleness, HoldsForFiveMillisecondsAndIsOverAfterTwenty) {
  for (double rate_Hz : kRates_Hz) {
    Staleness staleness;
    const double dt_s = 1.0 / rate_Hz;
    EXPECT_EQ(staleness.update(true, {}, dt_s).share, 1.0);
    for (int tick = 1; tick * dt_s < 0.03; ++tick) {
      const double age_s = tick * dt_s;
      const Staleness::Output output = staleness.update(false, {}, dt_s);
      EXPECT_EQ(output.holds, age_s > 0.003 + 1e-9) << age_s;
      EXPECT_NEAR(output.share, std::clamp((0.02 - age_s) / 0.015, 0.0, 1.0), 1e-9) << age_s;
      EXPECT_EQ(output.overdue, age_s > 0.02 - 1e-9) << age_s;
    }
    EXPECT_EQ(staleness.update(true, {}, dt_s).share, 1.0);
  }
  EXPECT_TRUE(Staleness().update(false, {}, 0.05).overdue) << "one long pause";
}

TEST(VelocityGuard, DampsBeyond600AndLetsGoFor100MillisecondsBeyond1000) {
  for (double rate_Hz : kRates_Hz) {
    VelocityGuard guard;
    const double dt_s = 1.0 / rate_Hz;
    const auto at = [&](double mm_per_s) { return guard.update({0.0, -mm_per_s, 0.0}, {}, dt_s); };
    EXPECT_EQ(at(599.0).brake_N, glm::dvec3(0.0));
    EXPECT_NEAR(at(800.0).brake_N.y, 200.0 * 0.005, 1e-12);
    EXPECT_FALSE(at(999.0).cuts);
    EXPECT_TRUE(at(1001.0).cuts);
    EXPECT_EQ(guard.update({0.0, 0.0, 1001.0}, {}, dt_s).brake_N, glm::dvec3(0.0));
    double s = 0.0;
    while (at(10.0).cuts && s < 1.0) s += dt_s;
    EXPECT_NEAR(s, 0.1, 1.01 * dt_s);
    EXPECT_TRUE(at(1e300).cuts);
  }
}

/// A velocity that swings at a frequency; true once the force is halved, and off.
struct Shaken {
  bool halved = false, off = false;
};
Shaken shaken(double swings_Hz, double amplitude_mm_per_s, double rate_Hz, double seconds) {
  BuzzDetector buzz;
  Shaken shaken;
  for (int tick = 0; tick < static_cast<int>(seconds * rate_Hz); ++tick) {
    const double t = (tick + 0.25) / rate_Hz, v = amplitude_mm_per_s * std::sin(6.283185307 * swings_Hz * t);
    const auto output = buzz.update({0.6 * v, 0.0, 0.8 * v}, {}, 1.0 / rate_Hz);
    shaken.halved = shaken.halved || output.share <= 0.5;
    shaken.off = shaken.off || output.off;
  }
  return shaken;
}

TEST(BuzzDetector, HearsWhatTurnsMoreThanTwentyTimesInATenthOfASecond) {
  // f swings a second are 2 f turns; 20 in 0.1 s are 100 Hz.
  for (double rate_Hz : {1000.0, 4000.0, 10'000.0}) {
    EXPECT_FALSE(shaken(92.0, 80.0, rate_Hz, 1.0).halved) << rate_Hz;
    EXPECT_TRUE(shaken(108.0, 80.0, rate_Hz, 0.3).off) << rate_Hz;
    EXPECT_TRUE(shaken(108.0, 80.0, rate_Hz, 0.15).halved) << rate_Hz;
    EXPECT_FALSE(shaken(108.0, 80.0, rate_Hz, 0.15).off) << "halving gets its chance";
    EXPECT_FALSE(shaken(108.0, 19.0, rate_Hz, 1.0).halved) << "too gentle to count";
    EXPECT_FALSE(shaken(4.0, 300.0, rate_Hz, 1.0).halved) << "a hand at work";
  }
}

TEST(BuzzDetector, ComesBackByStepsAfterASecondOfCalm) {
  BuzzDetector buzz;
  for (int tick = 0; tick < 300; ++tick) buzz.update({tick % 4 < 2 ? 50.0 : -50.0, 0.0, 0.0}, {}, 1e-3);
  BuzzDetector::Output output = buzz.update({}, {}, 1e-3);
  EXPECT_TRUE(output.off);
  EXPECT_EQ(output.share, 0.0);
  double last = 0.0;
  const auto calm = [&](int ms) {
    for (int tick = 0; tick < ms; ++tick) {
      output = buzz.update({0.0, 30.0, 0.0}, {}, 1e-3);
      EXPECT_LE(output.share - last, 1e-3 + 1e-12);
      last = output.share;
    }
  };
  calm(900);
  EXPECT_TRUE(output.off);
  calm(900);
  EXPECT_FALSE(output.off);
  EXPECT_EQ(output.share, 0.5);
  calm(2000);
  EXPECT_EQ(output.share, 1.0);
}

TEST(ThermalBudget, KeepsTheMeanSquareOfAnyTenSecondsWithinTheContinuousForce) {
  for (double rate_Hz : {500.0, 1000.0})
    for (unsigned seed = 0; seed < 3; ++seed) {
      std::mt19937 random(seed);
      const double dt_s = 1.0 / rate_Hz, C = 0.88;
      const auto window = static_cast<std::size_t>(10.0 * rate_Hz);
      ThermalBudget budget;
      std::vector<double> squares;
      double wish_N = 3.3, sum = 0.0, most = 0.0;
      for (int tick = 0; tick < static_cast<int>(60.0 * rate_Hz); ++tick) {
        // Rests to fill the bucket, then presses; seed 0 presses always.
        if (seed > 0 && tick % static_cast<int>(0.7 * rate_Hz) == 0) wish_N = random() % 3 == 0 ? 3.3 : 0.2;
        const double given_N = std::min(wish_N, budget.maxForce_N(C));
        budget.spend(given_N, C, dt_s);
        squares.push_back(given_N * given_N * dt_s);
        sum += squares.back();
        if (squares.size() > window) sum -= squares[squares.size() - 1 - window];
        most = std::max(most, sum);
      }
      EXPECT_LE(std::sqrt(most / 10.0), C * (1.0 + 1e-9));
      EXPECT_GT(std::sqrt(most / 10.0), 0.84 * C) << "and gives what there is";
    }
}

TEST(ThermalBudget, GivesATouchItsPeakFromColdAndNeverLessThanItsShare) {
  ThermalBudget budget;
  EXPECT_GT(budget.maxForce_N(0.88), 3.3);
  double at_peak_s = 0.0, last_N = 3.3;
  for (int tick = 0; tick < 5000; ++tick) {
    const double most_N = budget.maxForce_N(0.88);
    at_peak_s += most_N >= 3.3 ? 1e-3 : 0.0;
    ASSERT_GE(most_N, 0.88 * std::sqrt(0.7) - 1e-12);
    ASSERT_GT(most_N, last_N - 0.01) << "not felt as a step";
    last_N = std::min(most_N, 3.3);
    budget.spend(std::min(3.3, most_N), 0.88, 1e-3);
  }
  EXPECT_GT(at_peak_s, 0.015);
  EXPECT_NEAR(budget.maxForce_N(0.88), 0.88 * std::sqrt(0.7), 1e-3);
  EXPECT_EQ(ThermalBudget().maxForce_N(0.0), 0.0);
}

TEST(Heat, LowersTheForceInALineFromEightTenthsOn) {
  EXPECT_EQ(shareAtHeat(0.0, {}), 1.0);
  EXPECT_EQ(shareAtHeat(0.8, {}), 1.0);
  EXPECT_NEAR(shareAtHeat(0.9, {}), 0.65, 1e-12);
  for (double hot : {1.0, 1.7, kNan, std::numeric_limits<double>::infinity()})
    EXPECT_NEAR(shareAtHeat(hot, {}), 0.3, 1e-12);
}

TEST(JointTorques, ScaleTheWholeForceToTheJointThatBearsLeast) {
  const glm::dmat3 J(glm::dvec3(100.0, 0.0, 0.0), glm::dvec3(0.0, 50.0, 0.0), glm::dvec3(0.0, 0.0, 200.0));
  EXPECT_EQ(shareForJoints(J, {1.0, 1.0, 1.0}, glm::dvec3(200.0)), 1.0);
  EXPECT_EQ(shareForJoints(J, {1.0, 1.0, -2.0}, glm::dvec3(200.0)), 0.5);
  EXPECT_EQ(shareForJoints(J, {4.0, 1.0, -2.0}, {100.0, 0.0, 0.0}), 0.25) << "0 is no limit";
  EXPECT_EQ(shareForJoints(glm::dmat3(0.0), glm::dvec3(9.0), glm::dvec3(1.0)), 1.0) << "nothing known";
}

}  // namespace
}  // namespace haptics
