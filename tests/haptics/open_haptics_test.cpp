#include "haptics/device/openhaptics/open_haptics.h"

#include <glm/gtc/quaternion.hpp>

#include "calibration/arm/phantom_models.h"
#include "tests/haptics/open_haptics_bench.h"

namespace haptics {
namespace {

using namespace open_haptics_bench;
using testing::HasSubstr;

class OpenHapticsDevice : public OpenHapticsBench {};

TEST_F(OpenHapticsDevice, ReportsItsCapabilities) {
  OpenHaptics device(library);
  const DeviceCapabilities& can = device.capabilities();
  EXPECT_EQ(can.model, "PHANTOM Omni");
  EXPECT_EQ(can.serial, "50127600138");
  EXPECT_EQ(can.provenance, Provenance::vendor_library);
  EXPECT_TRUE(can.has_motors && can.has_orientation && can.has_inkwell);
  EXPECT_FALSE(can.has_deadman || can.peak_torque_Nmm > 0.0);
  EXPECT_EQ(can.peak_force_N, 3.3);
  EXPECT_EQ(can.continuous_force_N, 0.88);
  EXPECT_EQ(can.peak_joint_torque_Nmm, glm::dvec3(350.0));
  EXPECT_EQ(can.max_stiffness_N_per_mm, 0.5);
  EXPECT_EQ(can.max_damping_Ns_per_mm, 0.003);
  EXPECT_EQ(can.max_rate_Hz, 1000.0);
  EXPECT_EQ(can.workspace.min_D_mm, glm::dvec3(-160.0, -70.0, -58.0));
  EXPECT_EQ(can.workspace.max_D_mm, glm::dvec3(160.0, 200.0, 90.0));
  EXPECT_FALSE(door.seen.motors_on);
}

TEST_F(OpenHapticsDevice, RefusesADeviceThatDoesNotReportItsForce) {
  for (double told : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    door.script.max_force_N = told;
    EXPECT_THROW(OpenHaptics{library}, DeviceError);
    EXPECT_EQ(door.open_devices(), 0);
  }
}

TEST_F(OpenHapticsDevice, AppliesNewtonsAlongItsAxesAndTheHandYields) {
  const glm::dvec3 force_N(0.6, -0.3, 0.2);
  Pusher servo(force_N);
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  // The stand-in's grip has 0.3 N/mm.
  const glm::dvec3 rest_mm(0.0, -65.5, -88.1), pushed_mm = rest_mm + force_N / 0.3;
  until([&] { return glm::length(servo.state().X_DH.translation_mm - pushed_mm) < 0.01; });
  for (int i = 0; i < 3; ++i) EXPECT_EQ(door.seen.force_N[static_cast<std::size_t>(i)], force_N[i]);
  EXPECT_TRUE(servo.state().healthy);
  EXPECT_EQ(device.trouble(), "");
  device.stop();
  EXPECT_EQ(servo.begun, 1);
}

TEST_F(OpenHapticsDevice, KeepsTheOrderThatTheVendorRequires) {
  Pusher servo({0.0, 1.0, 0.0});
  {
    OpenHaptics device(library, {.configuration = "Left"});
    device.start(servo, 1000.0);
    runFor(servo, 20);
    device.stop();
    const long ticks = servo.ticks;
    device.stop();
    EXPECT_EQ(servo.ticks, ticks);
  }
  // Guards on, the highest priority, motors on only for the first force; no force, motors off, and then the rest.
  EXPECT_THAT(door.seen.events,
              testing::ElementsAre("init Left", "enable 0x4001", "enable 0x4002", "enable 0x4003", "enable 0x2606",
                                   "enable 0x2607", "schedule 65535", "start", "enable 0x4000", "force begins",
                                   "force ends", "disable 0x4000", "stop", "unschedule", "disable device"));
  EXPECT_EQ(forceNow_N(), 0.0);
}

TEST_F(OpenHapticsDevice, KeepsItsMotorsOffUntilACommandTurnsThemOn) {
  Pusher servo({0.0, 1.0, 0.0});
  servo.pushes = false;
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  runFor(servo, 20);
  EXPECT_FALSE(door.seen.motors_on);
  EXPECT_EQ(strongest_N(), 0.0);
  servo.pushes = true;
  until([&] { return door.seen.motors_on && forceNow_N() == 1.0; });
  servo.pushes = false;
  until([&] { return !door.seen.motors_on; });
  device.stop();
}

TEST_F(OpenHapticsDevice, ReadsTheTransformByColumns) {
  const glm::dquat R = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  const glm::dmat3 columns = glm::mat3_cast(R);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      door.script.turn[static_cast<std::size_t>(4 * column + row)] = columns[column][row];
  door.script.buttons = 0b0110;
  Pusher servo;
  OpenHaptics device(library, {.pedal_buttons = 0b0100});
  device.start(servo, 1000.0);
  runFor(servo, 20);
  const HandleState state = servo.state();
  EXPECT_GT(std::abs(glm::dot(state.X_DH.rotation, R)), 1.0 - 1e-12);
  EXPECT_LT(glm::length(state.X_DH.translation_mm - glm::dvec3(0.0, -65.5, -88.1)), 1e-9);
  EXPECT_TRUE(state.fresh);
  EXPECT_EQ(state.buttons, 0b0110u);
  EXPECT_TRUE(state.pedal);
  door.script.buttons = 0b0010;
  until([&] { return !servo.state().pedal; });

  // The hand goes 100 mm to the right, and the velocity with it.
  door.script.hand_mm[0] = 100.0;
  until([&] { return servo.state().X_DH.translation_mm.x > 99.0; });
  EXPECT_GT(servo.max_speed_mm_per_s, 50.0);
  device.stop();
}

TEST_F(OpenHapticsDevice, KnowsTheJacobianOfThePhantomsWhoseGeometryIsPublic) {
  const glm::dvec3 arm_rad(0.2, 0.5, -0.1);
  for (std::size_t i = 0; i < 3; ++i) {
    door.script.joints_rad[i] = arm_rad[static_cast<int>(i)];
    door.script.gimbal_rad[i] = 0.1 * static_cast<double>(i + 1);
  }
  const std::pair<const char*, const calibration::PhantomGeometry*> models[] = {
      {"PHANTOM Omni", &calibration::kOmniGeometry},
      {"Touch", &calibration::kOmniGeometry},
      {"PHANTOM Premium 1.5 6DOF", &calibration::kPremium15Geometry},
      {"PHANTOM Desktop", nullptr},
      {"Touch X", nullptr},
      {"PHANTOM Premium 3.0 6DOF", nullptr}};
  for (const auto& [model, geometry] : models) {
    door.reset();
    for (std::size_t i = 0; i < 3; ++i) {
      door.script.joints_rad[i] = arm_rad[static_cast<int>(i)];
      door.script.gimbal_rad[i] = 0.1 * static_cast<double>(i + 1);
    }
    door.script.model = model;
    Pusher servo;
    OpenHaptics device(library);
    device.start(servo, 1000.0);
    runFor(servo, 3);
    const glm::dmat3 expected = geometry ? calibration::armJacobian_mm(*geometry, arm_rad) : glm::dmat3(0.0);
    EXPECT_EQ(servo.state().jacobian_D_mm, expected) << model;
    EXPECT_TRUE(servo.state().has_joints) << model;
    EXPECT_EQ(servo.state().joints_rad, (calibration::RawJoints{0.2, 0.5, -0.1, 0.1, 0.1 * 2.0, 0.1 * 3.0}));
    device.stop();
    EXPECT_THAT(door.seen.violations, testing::IsEmpty());
  }
}

TEST_F(OpenHapticsDevice, SensesTheHandOnlyWithAConductiveStylus) {
  for (const char* model : {"PHANTOM Desktop", "PHANTOM Omni"}) {
    door.reset();
    door.script.model = model;
    door.script.held = false;
    Pusher servo;
    OpenHaptics device(library);
    const bool has_deadman = device.capabilities().has_deadman;
    EXPECT_EQ(has_deadman, model == std::string("PHANTOM Desktop"));
    device.start(servo, 1000.0);
    runFor(servo, 3);
    EXPECT_EQ(servo.state().held, !has_deadman);
    device.stop();
  }
}

TEST_F(OpenHapticsDevice, LearnsThePolarityOfTheInkwellSwitch) {
  for (bool docked_value : {false, true}) {
    door.reset();
    door.script.docked_value = docked_value;
    door.script.docked = true;
    Pusher servo;
    OpenHaptics device(library);
    device.start(servo, 1000.0);
    runFor(servo, 5);
    EXPECT_TRUE(servo.state().docked);
    EXPECT_EQ(device.dockedValue(), std::nullopt);
    door.script.docked = false;
    door.script.hand_mm[1] = 0.0;
    until([&] { return !servo.state().docked; });
    EXPECT_EQ(device.dockedValue(), docked_value);
    door.script.docked = true;
    until([&] { return servo.state().docked; });
    device.stop();
  }
}

TEST_F(OpenHapticsDevice, UsesTheConfiguredPolarityOfTheInkwell) {
  door.script.docked_value = false;
  Pusher servo;
  OpenHaptics device(library, {.docked_value = false});
  device.start(servo, 1000.0);
  runFor(servo, 3);
  EXPECT_FALSE(servo.state().docked);
  device.stop();
}

TEST_F(OpenHapticsDevice, ADeviceOfThreeDegreesNeverRotatesItsHandle) {
  door.script.input_dof = 3;
  door.script.gimbal_rad[1] = 0.4;
  Pusher servo;
  OpenHaptics device(library);
  EXPECT_FALSE(device.capabilities().has_orientation);
  device.start(servo, 1000.0);
  runFor(servo, 3);
  EXPECT_EQ(servo.state().X_DH.rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
  EXPECT_TRUE(servo.state().fresh);
  device.stop();
}

TEST_F(OpenHapticsDevice, ReportsTheHeatOfItsWarmestMotor) {
  door.script.heat = 0.7;
  Pusher servo;
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  runFor(servo, 3);
  EXPECT_EQ(servo.state().motor_heat, 0.7);
  // The library's complaint counts as all the heat there may be, whatever its number says.
  door.script.error_code = 0x0200;
  until([&] { return servo.state().motor_heat == 1.0; });
  EXPECT_TRUE(servo.state().healthy);
  until([&] { return servo.state().motor_heat == 0.7; });
  device.stop();
}

TEST_F(OpenHapticsDevice, CalibratesByItsStyleAndGivesNoForceBefore) {
  struct Style {
    int bits;
    const char* asks;
  };
  for (const Style style :
       {Style{2, ""}, Style{4, "put the stylus into its inkwell"}, Style{1, "reset position"}, Style{6, ""}}) {
    door.reset();
    door.script.calibration_style = style.bits;
    door.script.calibrated = false;
    Pusher servo({0.0, 1.0, 0.0});
    OpenHaptics device(library);
    device.start(servo, 1000.0);
    runFor(servo, 5);
    if (style.bits == 4 || style.bits == 1) {
      EXPECT_FALSE(servo.state().calibrated);
      EXPECT_EQ(strongest_N(), 0.0);
      EXPECT_FALSE(door.seen.motors_on);
      EXPECT_THAT(device.trouble(), HasSubstr(style.asks));
    }
    if (style.bits == 4) door.script.docked = true;
    if (style.bits == 1) device.setHome();
    until([&] { return servo.state().calibrated && forceNow_N() == 1.0; });
    EXPECT_EQ(device.trouble(), "");
    EXPECT_EQ(door.seen.calibration_updates, 1);

    // Lost again in the middle of the work: no force until it is back.
    const long uncalibrated = servo.uncalibrated;
    door.script.docked = false;
    door.script.calibrated = false;
    until([&] { return servo.uncalibrated > uncalibrated; });
    if (style.bits == 4) door.script.docked = true;
    if (style.bits == 1) device.setHome();
    until([&] { return door.seen.calibration_updates == 2 && servo.state().calibrated; });
    device.stop();
    EXPECT_THAT(door.seen.violations, testing::IsEmpty());
  }
}

TEST_F(OpenHapticsDevice, DoesNotReadMissingPropertiesAgain) {
  door.script.model = "PHANTOM Premium 3.0 6DOF";
  door.script.unknown_properties[0] = hd::kCurrentInkwellSwitch;
  door.script.unknown_properties[1] = hd::kCurrentGimbalAngles;
  door.script.unknown_properties[2] = hd::kMotorTemperature;
  door.script.unknown_properties[3] = hd::kCurrentVelocity;
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  runFor(servo, 300);
  EXPECT_TRUE(servo.state().healthy);
  EXPECT_FALSE(servo.state().docked);
  EXPECT_FALSE(servo.state().has_joints) << "half an arm's angles are none";
  EXPECT_EQ(device.errors().count(0x0100), 4u);
  device.stop();
}

TEST_F(OpenHapticsDevice, AllocatesNothingOnTheSchedulersThread) {
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return servo.ticks > 600; });
  device.stop();
  EXPECT_EQ(servo.allocations_at_500 - servo.allocations_at_100, 0u);
}

TEST_F(OpenHapticsDevice, HoldsTheLastPoseDuringInvalidReadings) {
  Pusher servo;
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  runFor(servo, 10);
  door.script.garbage = true;
  until([&] { return !servo.state().fresh; });
  EXPECT_LT(glm::length(servo.state().X_DH.translation_mm - glm::dvec3(0.0, -65.5, -88.1)), 1e-9);
  door.script.garbage = false;
  until([&] { return servo.state().fresh; });
  for (auto& number : door.script.turn) number = 0.0;
  until([&] { return !servo.state().fresh; });
  EXPECT_NEAR(glm::length(servo.state().X_DH.rotation), 1.0, 1e-12);
  device.stop();
}

}  // namespace
}  // namespace haptics
