#include "haptics/safety/safety_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace haptics {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

constexpr auto kSlowly = SafetyFilter::Fall::at_slew, kAtOnce = SafetyFilter::Fall::at_once;

Wrench<calibration::Patient> force(double x, double y, double z) { return {{{x, y, z}}, {}}; }

TEST(Safety, NeverExceedsItsLimitsWhateverIsWanted) {
  std::mt19937 random(1);
  std::normal_distribution<double> wild(0.0, 5.0);
  SafetyFilter filter;
  const SafetyLimits limits{3.0, 200.0, 40.0, 4000.0};
  glm::dvec3 last(0.0), last_torque(0.0);
  for (int tick = 0; tick < 20'000; ++tick) {
    glm::dvec3 wanted(wild(random), wild(random), wild(random));
    if (tick % 17 == 0) wanted.x = kNan;
    if (tick % 23 == 0) wanted.y = -kInf;
    if (tick % 29 == 0) wanted.z = 1e300;
    const auto served = filter.serve({{wanted}, {-20.0 * wanted}}, limits, kSlowly, 1e-3);
    ASSERT_LE(glm::length(served.wrench_P.force_N.xyz), 3.0 * (1.0 + 1e-12));
    ASSERT_LE(glm::length(served.wrench_P.force_N.xyz - last), 0.2 * (1.0 + 1e-12));
    last = served.wrench_P.force_N.xyz;
    ASSERT_LE(glm::length(served.wrench_P.torque_Nmm.xyz), 40.0 * (1.0 + 1e-12));
    ASSERT_LE(glm::length(served.wrench_P.torque_Nmm.xyz - last_torque), 4.0 * (1.0 + 1e-12));
    last_torque = served.wrench_P.torque_Nmm.xyz;
  }
}

TEST(Safety, LetsAllowedForceThroughUntouched) {
  SafetyFilter filter;
  const auto served = filter.serve(force(0.1, -0.05, 0.02), {}, kSlowly, 1e-3);
  EXPECT_EQ(served.wrench_P.force_N.xyz, glm::dvec3(0.1, -0.05, 0.02));
  EXPECT_EQ(served.faults, Fault::none);
}

TEST(Safety, GivesNoTorqueToADeviceThatHasNone) {
  SafetyFilter filter;
  SafetyLimits limits;
  limits.peak_torque_Nmm = 0.0;
  for (int tick = 0; tick < 20; ++tick) {
    const auto served = filter.serve({{{0.1, 0.0, 0.0}}, {{0.0, 9.0, 0.0}}}, limits, kSlowly, 1e-3);
    EXPECT_EQ(served.wrench_P.torque_Nmm.xyz, glm::dvec3(0.0));
    EXPECT_EQ(served.wrench_P.force_N.xyz, glm::dvec3(0.1, 0.0, 0.0));
  }
}

TEST(Safety, SaysWhatItDid) {
  SafetyFilter filter;
  const auto served = filter.serve(force(10.0, 0.0, 0.0), {3.0, 300.0}, kSlowly, 1e-3);
  EXPECT_TRUE(has(served.faults, Fault::clamped));
  EXPECT_TRUE(has(served.faults, Fault::slewed));
  EXPECT_NEAR(served.wrench_P.force_N.xyz.x, 0.3, 1e-12);
  EXPECT_TRUE(has(filter.serve(force(kNan, 0.0, 0.0), {}, kSlowly, 1e-3).faults, Fault::bad_force));
}

TEST(Safety, FallsAtTheSlewLimitUnlessSomethingTripped) {
  SafetyFilter filter;
  for (int tick = 0; tick < 20; ++tick) filter.serve(force(2.0, 0.0, 0.0), {}, kSlowly, 1e-3);
  double last = 2.0;
  for (int tick = 0; tick < 7; ++tick) {
    const double now = filter.serve(force(0.0, 0.0, 0.0), {}, kSlowly, 1e-3).wrench_P.force_N.xyz.x;
    EXPECT_GE(now, last - 0.3 - 1e-12);
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_EQ(last, 0.0);

  for (int tick = 0; tick < 20; ++tick) filter.serve(force(2.0, 0.0, 0.0), {}, kSlowly, 1e-3);
  EXPECT_EQ(filter.serve(force(0.7, 0.0, 0.0), {}, kAtOnce, 1e-3).wrench_P.force_N.xyz.x, 0.7);
  EXPECT_NEAR(filter.serve(force(2.0, 0.0, 0.0), {}, kAtOnce, 1e-3).wrench_P.force_N.xyz.x, 1.0, 1e-12);
  EXPECT_EQ(filter.serve(force(0.0, 0.0, 0.0), {}, kAtOnce, 1e-3).wrench_P.force_N.xyz, glm::dvec3(0.0));
}

TEST(Safety, GivesJointsNoMoreThanTheyBearWhereverTheyStand) {
  // 3.3 N straight up at a Touch's inkwell pose are (0, 424, -160) N mm (reference/devices 4.3).
  const glm::dmat3 J(glm::dvec3(0.0), glm::dvec3(0.0, 424.0 / 3.3, 0.0), glm::dvec3(0.0, -160.0 / 3.3, 0.0));
  SafetyLimits limits;
  limits.peak_joint_torque_Nmm = glm::dvec3(350.0);
  SafetyFilter filter;
  SafetyFilter::Delivered served;
  for (int tick = 0; tick < 20; ++tick) served = filter.serve(force(0.0, 3.3, 0.0), limits, kSlowly, 1e-3, J);
  EXPECT_NEAR(served.wrench_P.force_N.xyz.y, 3.3 * 350.0 / 424.0, 1e-12);
  EXPECT_TRUE(has(served.faults, Fault::joints));
  // The arm moves under the force: what was within the limit is not any more, and obeys in the same tick.
  served = filter.serve(force(0.0, 3.3, 0.0), limits, kSlowly, 1e-3, 2.0 * J);
  EXPECT_NEAR(served.wrench_P.force_N.xyz.y, 3.3 * 175.0 / 424.0, 1e-12);
}

TEST(Safety, ObeysAFallingLimitAtOnce) {
  SafetyFilter filter;
  for (int tick = 0; tick < 20; ++tick) filter.serve(force(2.0, 0.0, 0.0), {}, kSlowly, 1e-3);
  EXPECT_NEAR(filter.serve(force(2.0, 0.0, 0.0), {0.5, 300.0}, kSlowly, 1e-3).wrench_P.force_N.xyz.x, 0.5, 1e-12);
}

TEST(Safety, TakesAbsurdLimitsForNoForceAndTheDefaultSlew) {
  for (double bad : {kNan, kInf, -1.0}) {
    EXPECT_EQ(sanitised({bad, 300.0}).peak_force_N, 0.0);
    EXPECT_EQ(sanitised({3.0, bad}).slew_N_per_s, SafetyLimits{}.slew_N_per_s);
  }
}

}  // namespace
}  // namespace haptics
