#include "haptics/device/usb/wooden_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

WoodenModel withGimbal() {
  WoodenModel model = woodenHaptics2019();
  model.gimbal_counts_per_turn = glm::dvec3(1024.0);
  model.direction = {1.0, -1.0, 1.0};
  return model;
}

/// Inside what the arm can do, away from the places where a joint has no say.
class RandomArm {
 public:
  glm::dvec3 operator()() {
    const double b = 0.1 + uniform_(generator_) * 1.2;
    const double c = 0.3 + uniform_(generator_) * std::min(1.5, kPi - b - 0.6);
    return {(uniform_(generator_) - 0.5) * 2.0, b, c};
  }
  double angle() { return (uniform_(generator_) - 0.5) * 2.0 * kPi; }

 private:
  std::mt19937 generator_{7};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

TEST(WoodenKinematics, KnowsItsHomePosition) {
  const WoodenKinematics wooden(woodenHaptics2015());
  const WoodenJoints home = wooden.joints({0, 0, 6000, 0, 0, 0});
  EXPECT_NEAR(home.arm_rad.x, 0.0, 1e-12);
  EXPECT_NEAR(home.arm_rad.y, 0.0, 1e-12);
  EXPECT_NEAR(home.arm_rad.z, 0.5 * kPi, 1e-12);
  // Upright and level: 245 mm out, 80 + 205 mm up, seen from an origin at (220, 0, 80).
  const glm::dvec3 p_mm = wooden.position(home.arm_rad).mm;
  EXPECT_NEAR(glm::distance(p_mm, glm::dvec3(25.0, 0.0, 205.0)), 0.0, 1e-12);
  EXPECT_EQ(wooden.handle(home).rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST(WoodenKinematics, JacobianIsTheSlopeOfThePosition) {
  const WoodenKinematics wooden(woodenHaptics2015());
  RandomArm random;
  for (int i = 0; i < 2'000; ++i) {
    const glm::dvec3 arm = random();
    const glm::dmat3 J = wooden.jacobian_mm(arm);
    for (int joint = 0; joint < 3; ++joint) {
      const double step = 1e-5;
      glm::dvec3 more = arm, less = arm;
      more[joint] += step;
      less[joint] -= step;
      const glm::dvec3 slope = (wooden.position(more).mm - wooden.position(less).mm) / (2.0 * step);
      EXPECT_LT(glm::distance(J[joint], slope), 1e-6);
    }
  }
}

TEST(WoodenKinematics, RotationIsTheProductOfItsFiveTurns) {
  const WoodenKinematics wooden(withGimbal());
  RandomArm random;
  const auto about = [](char axis, double t) {
    const double c = std::cos(t), s = std::sin(t);
    glm::dmat3 rows(1.0);
    if (axis == 'x') rows = {{1, 0, 0}, {0, c, -s}, {0, s, c}};
    if (axis == 'y') rows = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
    if (axis == 'z') rows = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
    return glm::transpose(rows);
  };
  for (int i = 0; i < 2'000; ++i) {
    const WoodenJoints joints{random(), {random.angle(), random.angle(), random.angle()}};
    const glm::dmat3 R = glm::mat3_cast(wooden.handle(joints).rotation);
    const glm::dmat3 product = about('z', joints.arm_rad.x) * about('y', 0.5 * kPi - joints.arm_rad.z) *
                               about('x', joints.gimbal_rad.x) * about('y', joints.gimbal_rad.y) *
                               about('x', joints.gimbal_rad.z);
    const glm::dmat3 rest = glm::transpose(R) * R - glm::dmat3(1.0);
    for (int column = 0; column < 3; ++column) {
      EXPECT_LT(glm::length(rest[column]), 1e-12);
      EXPECT_LT(glm::distance(R[column], product[column]), 1e-12);
    }
  }
}

TEST(WoodenKinematics, AGimbalIsWiredFromTheHandleInwards) {
  const WoodenKinematics wooden(withGimbal());
  const WoodenJoints joints = wooden.joints({0, 0, 0, 256, 0, 512});
  EXPECT_NEAR(joints.gimbal_rad.x, -kPi, 1e-12);
  EXPECT_NEAR(joints.gimbal_rad.z, -0.5 * kPi, 1e-12);
  EXPECT_EQ(WoodenKinematics(woodenHaptics2015()).joints({0, 0, 0, 256, 0, 512}).gimbal_rad, glm::dvec3(0.0));
}

TEST(WoodenKinematics, CurrentsAreThoseOfTheForceThroughTheCapstans) {
  const WoodenKinematics wooden(woodenHaptics2015());
  // At home 1 N sideways is 245 N mm of the turret, 15.31 N mm of its motor, 591 mA.
  const auto sideways = wooden.currents_mA({0.0, 0.0, 0.5 * kPi}, {{0.0, 1.0, 0.0}});
  EXPECT_NEAR(sideways[0], 1e3 * 245.0 * 10.0 / 160.0 / 25.9, 1e-9);
  EXPECT_NEAR(sideways[1], 0.0, 1e-9);
  EXPECT_NEAR(sideways[2], 0.0, 1e-9);
  // 1 N up is 245 N mm of the forearm, 20.4 N mm of its motor, 788 mA.
  const auto up = wooden.currents_mA({0.0, 0.0, 0.5 * kPi}, {{0.0, 0.0, 1.0}});
  EXPECT_NEAR(up[2], 1e3 * 245.0 * 10.0 / 120.0 / 25.9, 1e-9);
}

TEST(WoodenKinematics, MotorsGiveThePowerThatTheHandGets) {
  const WoodenModel model = withGimbal();
  const WoodenKinematics wooden(model);
  RandomArm random;
  for (int i = 0; i < 2'000; ++i) {
    const glm::dvec3 arm = random();
    const glm::dvec3 rate(random.angle(), random.angle(), random.angle());
    const glm::dvec3 force_N = 0.1 * glm::dvec3(random.angle(), random.angle(), random.angle());
    const auto mA = wooden.currents_mA(arm, {force_N});
    // Motor torque k I turns with the motor's own speed, which its encoder counts.
    double power = 0.0;
    for (int m = 0; m < 3; ++m) {
      const double motor_rate = rate[m] * model.direction[m] * model.body_mm[m] / model.capstan_mm[m];
      power += 1e-3 * mA[static_cast<std::size_t>(m)] * model.motor_Nmm_per_A[m] * motor_rate;
    }
    EXPECT_NEAR(power, glm::dot(force_N, wooden.jacobian_mm(arm) * rate), 1e-9);
  }
}

TEST(WoodenKinematics, NoMotorGetsMoreThanTheClampAndTheDirectionStays) {
  for (const WoodenModel& model : {woodenHaptics2015(), woodenHaptics2019(), withGimbal()}) {
    const WoodenKinematics wooden(model);
    RandomArm random;
    EXPECT_EQ(model.clamp_mA(), 2000.0);
    for (int i = 0; i < 5'000; ++i) {
      const glm::dvec3 arm = random();
      const glm::dvec3 force_N = glm::dvec3(random.angle(), random.angle(), random.angle()) * (i % 2 ? 1.0 : 1e6);
      const auto mA = wooden.currents_mA(arm, {force_N});
      glm::dvec3 torque(0.0);
      for (int m = 0; m < 3; ++m) {
        EXPECT_LE(std::abs(mA[static_cast<std::size_t>(m)]), 2000.0 * (1.0 + 1e-12));
        torque[m] = mA[static_cast<std::size_t>(m)] * model.motor_Nmm_per_A[m] * model.direction[m] * model.body_mm[m];
      }
      const glm::dvec3 got = glm::inverse(glm::transpose(wooden.jacobian_mm(arm))) * torque;
      EXPECT_GT(glm::dot(glm::normalize(got), glm::normalize(force_N)), 1.0 - 1e-9);
    }
    const auto none = wooden.currents_mA({0.0, 0.5, 1.0}, {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}});
    EXPECT_EQ(none, (std::array<double, 3>{0.0, 0.0, 0.0}));
    const auto most = wooden.currents_mA({0.0, 0.5, 1.0}, {{std::numeric_limits<double>::infinity(), 0.0, 0.0}});
    EXPECT_EQ(most, (std::array<double, 3>{0.0, 0.0, 0.0}));
  }
}

TEST(WoodenModel, IsKnownByName) {
  EXPECT_EQ(woodenModelNamed("v2015")->name, "WoodenHaptics v2015");
  EXPECT_EQ(woodenModelNamed("v2019")->motor_Nmm_per_A.x, 321.0);
  EXPECT_FALSE(woodenModelNamed("v2020"));
  const glm::dvec3 peak = WoodenKinematics(woodenHaptics2015()).peakTorque_Nmm();
  EXPECT_NEAR(peak.x, 2.0 * 25.9 * 16.0, 1e-9);
  EXPECT_NEAR(peak.y, 2.0 * 25.9 * 12.0, 1e-9);
}

}  // namespace
}  // namespace haptics
