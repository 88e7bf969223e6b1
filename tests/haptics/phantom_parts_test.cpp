#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"
#include "haptics/device/simulated/dry_friction.h"
#include "haptics/device/simulated/motor_heat.h"
#include "haptics/device/simulated/phantom_sensors.h"
#include "haptics/device/simulated/tremor.h"

namespace haptics {
namespace {

using calibration::kOmniGeometry;
using calibration::PhantomJoints;

constexpr double kDry_N = 0.26;

VirtualHand block(double stiffness_N_per_mm, double damping_Ns_per_mm) {
  VirtualHand hand;
  hand.stiffness_N_per_mm = stiffness_N_per_mm;
  hand.damping_Ns_per_mm = damping_Ns_per_mm;
  return hand;
}

TEST(DryFriction, HoldsWithoutCreepBelowItsForce) {
  VirtualHand hand = block(0.3, 0.003);
  for (int tick = 0; tick < 5000; ++tick)
    advanceWithDryFriction(hand, kDry_N, glm::dvec3(0.0), glm::dvec3(0.0), {0.0, 0.99 * kDry_N, 0.0}, 1e-3);
  EXPECT_EQ(hand.position_mm, glm::dvec3(0.0));
  advanceWithDryFriction(hand, kDry_N, glm::dvec3(0.0), glm::dvec3(0.0), {0.0, 1.01 * kDry_N, 0.0}, 1e-3);
  EXPECT_GT(hand.position_mm.y, 0.0);
}

TEST(DryFriction, StopsASlidingBlockWhereItsEnergyIsSpent) {
  // m v^2 / (2 F) = 0.1 kg (0.1 m/s)^2 / 0.52 N.
  for (double dt_s : {1e-4, 1e-3, 20e-3}) {
    VirtualHand hand = block(0.0, 0.0);
    hand.velocity_mm_per_s = {60.0, -80.0, 0.0};
    for (int tick = 0; tick * dt_s < 0.2; ++tick)
      advanceWithDryFriction(hand, kDry_N, glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), dt_s);
    EXPECT_NEAR(glm::length(hand.position_mm), 1000.0 * 0.1 * 0.01 / (2.0 * kDry_N), 1e-6) << dt_s;
    EXPECT_EQ(hand.velocity_mm_per_s, glm::dvec3(0.0));
  }
}

TEST(DryFriction, TakesTheSameEnergyFromEverySwing) {
  // A spring's turning points come nearer by 2 F / k each.
  VirtualHand hand = block(0.3, 0.0);
  hand.position_mm.x = 10.0;
  std::vector<double> turns{10.0};
  double last = 0.0;
  for (int tick = 0; tick < 5000; ++tick) {
    advanceWithDryFriction(hand, kDry_N, glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), 0.1e-3);
    if (last * hand.velocity_mm_per_s.x < 0.0) turns.push_back(std::abs(hand.position_mm.x));
    if (hand.velocity_mm_per_s.x != 0.0) last = hand.velocity_mm_per_s.x;
  }
  ASSERT_EQ(turns.size(), 6u) << "then it sticks within F/k";
  for (std::size_t n = 1; n < turns.size(); ++n) EXPECT_NEAR(turns[n - 1] - turns[n], 2.0 * kDry_N / 0.3, 1e-3);
  EXPECT_EQ(hand.velocity_mm_per_s.x, 0.0);
  EXPECT_LE(std::abs(hand.position_mm.x), kDry_N / 0.3);
}

TEST(DryFriction, FollowsATargetAsManySmallStepsWould) {
  for (double damping : {0.001, 0.01}) {
    VirtualHand hand = block(0.3, damping), slow = hand;
    const auto target = [](double t) { return 5.0 * glm::dvec3(std::sin(9.0 * t), std::cos(7.0 * t) - 1.0, t); };
    constexpr int kSteps = 400;
    for (int tick = 0; tick < 600; ++tick) {
      const double t = tick * 1e-3;
      const glm::dvec3 from = target(t), speed = (target(t + 1e-3) - from) / 1e-3,
                       push(0.3 * std::sin(20.0 * t), 0.1, 0.0);
      advanceWithDryFriction(hand, kDry_N, from, speed, push, 1e-3);
      for (int step = 0; step < kSteps; ++step) {
        const double dt = 1e-3 / kSteps;
        const glm::dvec3 pull =
            0.3 * (from + speed * (step * dt) - slow.position_mm) + damping * (speed - slow.velocity_mm_per_s) + push;
        // Friction takes what it can of the speed, and no more.
        const glm::dvec3 free = slow.velocity_mm_per_s + dt * 1e4 * pull;
        const double quick = glm::length(free), taken = dt * 1e4 * kDry_N;
        slow.velocity_mm_per_s = quick > taken ? free * (1.0 - taken / quick) : glm::dvec3(0.0);
        slow.position_mm += dt * slow.velocity_mm_per_s;
      }
      ASSERT_LT(glm::distance(hand.position_mm, slow.position_mm), 5e-3) << tick << " " << damping;
    }
  }
}

TEST(MotorHeat, SettlesAtTheSquareOfItsLoad) {
  MotorHeat heat({90.0, 90.0, 90.0}, 30.0);
  for (int tick = 0; tick < 30'000; ++tick) heat.add({45.0, 90.0, -60.0}, 1e-3);
  EXPECT_NEAR(heat.warmest(), 1.0 - std::exp(-1.0), 1e-9);
  for (int tick = 0; tick < 30'000; ++tick) heat.add(glm::dvec3(0.0), 1e-3);
  EXPECT_NEAR(heat.warmest(), (1.0 - std::exp(-1.0)) * std::exp(-1.0), 1e-9);
  heat.add({180.0, 0.0, 0.0}, 1e9);
  EXPECT_NEAR(heat.warmest(), 4.0, 1e-12);
}

TEST(Tremor, HasItsAmplitudeBetweenEightAndTwelveHertz) {
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    const Tremor tremor(0.05, seed);
    constexpr int kSamples = 2000;  // 20 s
    std::vector<glm::dvec3> course;
    for (int n = 0; n < kSamples; ++n) course.push_back(tremor.at(n * 0.01));
    double square = 0.0, in_band = 0.0;
    for (const glm::dvec3& away : course) square += glm::dot(away, away) / kSamples;
    EXPECT_NEAR(std::sqrt(square), 0.05, 0.01) << seed;
    for (double frequency_Hz = 7.5; frequency_Hz <= 12.5; frequency_Hz += 0.05)
      for (int axis = 0; axis < 3; ++axis) {
        std::complex<double> sum = 0.0, turn = 1.0;
        for (const glm::dvec3& away : course) {
          sum += away[axis] * turn;
          turn *= std::polar(1.0, -2.0 * calibration::kPi * frequency_Hz * 0.01);
        }
        in_band += 2.0 * std::norm(sum / static_cast<double>(kSamples));
      }
    EXPECT_NEAR(in_band / square, 1.0, 0.03) << seed;
  }
  EXPECT_NE(Tremor(0.05, 1).at(0.3), Tremor(0.05, 2).at(0.3));
  EXPECT_EQ(Tremor(0.0, 1).at(0.3), glm::dvec3(0.0));
}

TEST(PhantomSensors, CountAtTheJoints) {
  PhantomSensors sensors(kOmniGeometry, {15'200.0, 0.0, 0.0}, 1);
  const double count_rad = 2.0 * calibration::kPi / 15'200.0;
  for (int n = 0; n < 500; ++n) {
    PhantomJoints truth;
    truth.arm_rad = {0.3 * std::sin(0.7 * n), 0.7 + 0.3 * std::sin(1.1 * n), 0.6 + 0.3 * std::cos(0.9 * n)};
    const auto reading = sensors.read(truth, glm::dvec3(0.0), 1e-3);
    const glm::dvec3 seen = armAnglesFor(kOmniGeometry, {reading.X_DH.translation_mm}).value();
    for (int joint = 0; joint < 3; ++joint) {
      ASSERT_NEAR(seen[joint] / count_rad, std::round(seen[joint] / count_rad), 1e-5);
      ASSERT_LE(std::abs(seen[joint] - truth.arm_rad[joint]), 0.5 * count_rad + 1e-9);
    }
    for (int joint = 0; joint < 3; ++joint)
      ASSERT_NEAR(reading.joints_rad[static_cast<std::size_t>(joint)], seen[joint], 1e-9);
    const glm::dmat3 J = armJacobian_mm(kOmniGeometry, seen);
    for (int joint = 0; joint < 3; ++joint) ASSERT_LT(glm::distance(reading.jacobian_D_mm[joint], J[joint]), 1e-5);
  }
  // 0.055 mm where the turret alone moves the handle.
  EXPECT_NEAR(count_rad * 133.35, 0.055, 0.0005);
}

TEST(PhantomSensors, AddNoiseOfOneLevelToTheGimbal) {
  PhantomSensors sensors(kOmniGeometry, {0.0, 2048.0, 0.0}, 1);
  const double level_rad = 2.0 * calibration::kPi / 2048.0;
  PhantomJoints truth;
  truth.arm_rad = {0.1, 0.7, 0.5};
  truth.wrist_rad = {0.40 * level_rad, -0.3, 0.2};
  double mean = 0.0, most = 0.0;
  constexpr int kReadings = 4000;
  for (int n = 0; n < kReadings; ++n) {
    const auto reading = sensors.read(truth, glm::dvec3(0.0), 1e-3);
    const glm::dvec3 error = calibration::wristAnglesFor(truth.arm_rad, reading.X_DH.rotation) - truth.wrist_rad;
    mean += error.x / kReadings;
    most = std::max({most, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
    ASSERT_LT(glm::distance(reading.X_DH.translation_mm, wristPosition(kOmniGeometry, truth.arm_rad).mm), 1e-9);
  }
  EXPECT_LE(most, level_rad);
  EXPECT_GT(most, 0.4 * level_rad);
  EXPECT_NEAR(mean, 0.0, 0.05 * level_rad) << "noise as wide as a level leaves no bias";
}

TEST(PhantomSensors, FilterTheDifferencedVelocity) {
  PhantomSensors sensors(kOmniGeometry, {15'200.0, 0.0, 50.0}, 1);
  double last = 0.0, roughest = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    const glm::dvec3 place(0.0, -20.0 + 0.1 * tick, 0.0);
    const auto reading = sensors.read({armAnglesFor(kOmniGeometry, {place}).value(), glm::dvec3(0.0)}, {}, 1e-3);
    last = reading.velocity_D_mm_per_s.xyz.y;
    if (tick == 0) {
      EXPECT_EQ(last, 0.0);
    }
    if (tick > 50) roughest = std::max(roughest, std::abs(last - 100.0));
  }
  // A count a tick is 55 mm/s.
  EXPECT_LT(roughest, 15.0);
  EXPECT_GT(roughest, 0.5);
  PhantomSensors perfect(kOmniGeometry, {}, 1);
  EXPECT_EQ(perfect.read({}, {1.0, 2.0, 3.0}, 1e-3).velocity_D_mm_per_s.xyz, glm::dvec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace haptics
