#include "haptics/servo/tear_pulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "haptics/safety/safety_limits.h"

namespace haptics {
namespace {

constexpr glm::dvec3 kAxis{0.0, 0.6, 0.8};

struct Felt {
  double peak_N = 0.0, sum_Ns = 0.0, steepest_N = 0.0;
  int ticks = 0;  ///< with force
  glm::dvec3 side{0.0};
};

/// What is felt in `seconds` in which nothing more tears.
Felt feel(TearPulses& pulses, double dt_s, double seconds = 0.03) {
  Felt felt;
  glm::dvec3 before(0.0), sum(0.0);
  for (double t_s = 0.0; t_s < seconds; t_s += dt_s) {
    const glm::dvec3 force_N = pulses.update(0.0, false, kAxis, dt_s).xyz;
    if (felt.ticks == 0 && glm::length(force_N) > 0.0) felt.side = glm::normalize(force_N);
    felt.peak_N = std::max(felt.peak_N, glm::length(force_N));
    felt.steepest_N = std::max(felt.steepest_N, glm::distance(force_N, before));
    felt.ticks += glm::length(force_N) > 0.0;
    sum += dt_s * force_N;
    before = force_N;
  }
  felt.sum_Ns = glm::length(sum);
  return felt;
}

TEST(TearPulses, APulseForEachTwoMillijoulesThatTear) {
  TearPulses pulses;
  int begun = 0;
  double last_N = 0.0;
  for (int n = 0; n < 4000; ++n) {
    const double now_N = glm::length(pulses.update(0.05, false, kAxis, 1e-3).xyz);
    begun += last_N == 0.0 && now_N > 0.0;
    last_N = now_N;
  }
  EXPECT_NEAR(begun, 4000 * 0.05 / TearPulses::kGrain_Nmm, 1.0);
}

TEST(TearPulses, NothingBelowAGrain) {
  TearPulses pulses;
  EXPECT_EQ(pulses.update(0.9 * TearPulses::kGrain_Nmm, false, kAxis, 1e-3).xyz, glm::dvec3(0.0));
  EXPECT_EQ(feel(pulses, 1e-3).ticks, 0);
}

TEST(TearPulses, GoesOutAndBackWithMeanZeroAtEveryRate) {
  for (const double dt_s : {2e-3, 1e-3, 0.7e-3, 2.5e-4}) {
    TearPulses pulses;
    for (const bool crack : {false, true}) {
      glm::dvec3 sum = dt_s * pulses.update(crack ? 0.0 : 2.0, crack, kAxis, dt_s).xyz;
      EXPECT_GT(glm::length(sum), 0.0);
      for (int n = 0; n < 200; ++n) sum += dt_s * pulses.update(0.0, false, kAxis, dt_s).xyz;
      EXPECT_NEAR(glm::length(sum), 0.0, 1e-15) << dt_s;
    }
  }
}

TEST(TearPulses, TheMoreTearsAtOnceTheStrongerUpToTwice) {
  double before_N = 0.0;
  for (const double grains : {1.0, 2.0, 4.0, 6.0}) {
    TearPulses pulses;
    pulses.update(grains * TearPulses::kGrain_Nmm, false, kAxis, 1e-5);
    const double peak_N = feel(pulses, 1e-5).peak_N;
    const double expected_N = 0.2 + 0.2 * (grains - 1.0) / 5.0;
    EXPECT_NEAR(peak_N, expected_N, 1e-4);
    EXPECT_GT(peak_N, before_N);
    before_N = peak_N;
  }
  TearPulses pulses;
  pulses.update(1e9, false, kAxis, 1e-5);
  EXPECT_NEAR(feel(pulses, 1e-5).peak_N, TearPulses::kStrongest_N, 1e-4);
}

TEST(TearPulses, AlternatesAcrossTheAxisOfTheTool) {
  TearPulses pulses;
  glm::dvec3 before(0.0);
  for (int n = 0; n < 5; ++n) {
    const glm::dvec3 first_N = pulses.update(2.0, false, kAxis, 1e-3).xyz;
    EXPECT_NEAR(glm::dot(first_N, kAxis), 0.0, 1e-12);
    if (n > 0) {
      EXPECT_LT(glm::dot(first_N, before), 0.0);
    }
    before = first_N;
    feel(pulses, 1e-3);
  }
}

TEST(TearPulses, ACrackIsFeltOnceAndIsLongerAndStronger) {
  TearPulses pulses;
  pulses.update(0.0, true, kAxis, 1e-5);
  const Felt crack = feel(pulses, 1e-5, 0.05);
  EXPECT_NEAR(crack.peak_N, TearPulses::kCrack_N, 1e-4);
  EXPECT_NEAR(crack.ticks * 1e-5, TearPulses::kCrack_s, 1e-4);
  EXPECT_EQ(feel(pulses, 1e-3).ticks, 0);
}

TEST(TearPulses, ACrackWaitsForThePulseThatIsRunning) {
  TearPulses pulses;
  pulses.update(2.0, false, kAxis, 1e-3);
  pulses.update(0.0, true, kAxis, 1e-3);
  EXPECT_GT(feel(pulses, 1e-3, 0.05).peak_N, 0.9 * TearPulses::kCrack_N);
}

TEST(TearPulses, StaysBelowTheSlewLimitOfADeviceAndBounded) {
  TearPulses pulses;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> torn(-1.0, 20.0);
  glm::dvec3 before(0.0);
  for (int n = 0; n < 20'000; ++n) {
    const double torn_Nmm = n % 1000 == 7 ? std::nan("") : torn(random);
    const glm::dvec3 force_N = pulses.update(torn_Nmm, n % 97 == 0, kAxis, 1e-3).xyz;
    ASSERT_LE(glm::length(force_N), TearPulses::kCrack_N);
    ASSERT_LE(glm::distance(force_N, before), SafetyLimits{}.slew_N_per_s * 1e-3);
    before = force_N;
  }
}

TEST(TearPulses, AnAxisThatIsNoNumberIsSilent) {
  TearPulses pulses;
  EXPECT_EQ(pulses.update(2.0, false, glm::dvec3(std::nan("")), 1e-3).xyz, glm::dvec3(0.0));
  EXPECT_EQ(feel(pulses, 1e-3).ticks, 0);
  EXPECT_NE(pulses.update(2.0, false, kAxis, 1e-3).xyz, glm::dvec3(0.0)) << "the next pulse knows it again";
}

}  // namespace
}  // namespace haptics
