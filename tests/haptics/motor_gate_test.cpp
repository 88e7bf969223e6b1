#include "haptics/safety/motor_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace haptics {
namespace {

using calibration::Device;

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
const glm::dmat3 kUnknown(0.0);

DeviceCapabilities touch() {
  DeviceCapabilities device;
  device.peak_force_N = 3.3;
  device.peak_torque_Nmm = 50.0;
  device.peak_joint_torque_Nmm = glm::dvec3(350.0);
  return device;
}

Wrench<Device> push(const glm::dvec3& force_N) { return {{force_N}, {}}; }

TEST(MotorGate, AdmitsNothingBeyondTheDeviceWhateverIsWanted) {
  std::mt19937 random(3);
  std::normal_distribution<double> wild(0.0, 4.0);
  const MotorGate gate(touch());
  for (int i = 0; i < 100'000; ++i) {
    const auto any = [&] { return glm::dvec3(wild(random), wild(random), wild(random)); };
    glm::dvec3 force = any(), torque = 20.0 * any();
    glm::dmat3 J(30.0 * any(), 30.0 * any(), 30.0 * any());
    if (i % 13 == 0) force.y = kNan;
    if (i % 17 == 0) force.x = kInf;
    if (i % 19 == 0) torque.z = -kInf;
    if (i % 23 == 0) J[1][2] = kNan;
    if (i % 29 == 0) force.z = 1e300;
    const MotorCommand command = gate.admit({{force}, {torque}}, J, true);
    const Wrench<Device>& told = command.wrench_D();
    ASSERT_LE(glm::length(told.force_N.xyz), 3.3 * (1.0 + 1e-12));
    ASSERT_LE(glm::length(told.torque_Nmm.xyz), 50.0 * (1.0 + 1e-12));
    if (told.force_N.xyz != glm::dvec3(0.0)) {
      const glm::dvec3 joints = glm::abs(glm::transpose(J) * told.force_N.xyz);
      ASSERT_LE(glm::max(glm::max(joints.x, joints.y), joints.z), 350.0 * (1.0 + 1e-9));
    }
  }
}

TEST(MotorGate, LetsAllowedForceThroughUntouched) {
  const MotorCommand command = MotorGate(touch()).admit({{{0.3, -1.0, 2.0}}, {{5.0, 0.0, 0.0}}}, kUnknown, true);
  EXPECT_TRUE(command.motorsOn());
  EXPECT_EQ(command.wrench_D().force_N.xyz, glm::dvec3(0.3, -1.0, 2.0));
  EXPECT_EQ(command.wrench_D().torque_Nmm.xyz, glm::dvec3(5.0, 0.0, 0.0));
}

TEST(MotorGate, KeepsTheDirectionWhereAJointLimitBites) {
  // 3.3 N up at an Omni's inkwell pose want 424 N mm of the second joint (reference/devices 4.3); 350 are allowed.
  glm::dmat3 J(0.0);
  J[1] = {0.0, 128.5, 0.0};
  const MotorCommand command = MotorGate(touch()).admit(push({0.0, 3.3, 0.0}), J, true);
  EXPECT_NEAR(command.wrench_D().force_N.xyz.y, 350.0 / 128.5, 1e-12);
  EXPECT_EQ(command.wrench_D().force_N.xyz.x, 0.0);
}

TEST(MotorGate, OnceShutNothingPassesAnyMore) {
  MotorGate gate(touch());
  gate.shut();
  const MotorCommand command = gate.admit(push({1.0, 0.0, 0.0}), kUnknown, true);
  EXPECT_FALSE(command.motorsOn());
  EXPECT_EQ(command.wrench_D().force_N.xyz, glm::dvec3(0.0));
}

TEST(MotorGate, TakesAbsurdCapabilitiesForNoForce) {
  for (double bad : {kNan, kInf, -1.0, 0.0}) {
    DeviceCapabilities device = touch();
    device.peak_force_N = bad;
    EXPECT_EQ(MotorGate(device).admit(push({1.0, 0.0, 0.0}), kUnknown, true).wrench_D().force_N.xyz, glm::dvec3(0.0));
  }
}

TEST(MotorGate, TakesAJointLimitThatCanNotBeReadForTheTightest) {
  for (double bad : {kNan, kInf, -1.0}) {
    DeviceCapabilities device = touch();
    device.peak_joint_torque_Nmm.y = bad;
    glm::dmat3 J(0.0);
    J[1] = {0.0, 128.5, 0.0};
    EXPECT_LT(glm::length(MotorGate(device).admit(push({0.0, 1.0, 0.0}), J, true).wrench_D().force_N.xyz), 1e-9);
  }
}

TEST(MotorCommand, CanOnlyBeWeakened) {
  const MotorCommand full = MotorGate(touch()).admit(push({2.0, 0.0, 0.0}), kUnknown, true);
  EXPECT_EQ(full.scaled(0.25).wrench_D().force_N.xyz.x, 0.5);
  for (double bad : {kNan, 1.5, -0.5, kInf}) EXPECT_EQ(full.scaled(bad).wrench_D().force_N.xyz.x, 0.0);
}

}  // namespace
}  // namespace haptics
