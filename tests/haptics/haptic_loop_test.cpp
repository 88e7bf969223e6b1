#include "haptics/servo/haptic_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include "haptics/device/paced_device.h"
#include "haptics/device/simulated/mouse_device.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using namespace std::chrono_literals;

/// Stands still under the surface, remembers the force it is given, and can be slow once.
class PressedDevice final : public PacedDevice {
 public:
  explicit PressedDevice(int slow_at = -1, std::chrono::milliseconds slowness = 30ms)
      : slow_at_(slow_at), slowness_(slowness) {
    capabilities_.peak_force_N = 0.5;
  }
  ~PressedDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void setMotors() { capabilities_.has_motors = true; }
  void setPeakTorque(double peak_Nmm) { capabilities_.peak_torque_Nmm = peak_Nmm; }

  HandleState sense(double) noexcept override {
    HandleState state;
    state.X_DH.translation_mm = {0.0, 0.0, 1.0};
    return state;
  }
  void drive(const MotorCommand& command) noexcept override {
    last_N = glm::length(command.wrench_D().force_N.xyz);
    last_Nmm = glm::length(command.wrench_D().torque_Nmm.xyz);
    most_Nmm = std::max(most_Nmm, last_Nmm);
    most_N = std::max(most_N, last_N);
    motors_on = command.motorsOn();
    if (calls_++ == slow_at_) std::this_thread::sleep_for(slowness_);
  }
  void motorsOff() noexcept override {
    PacedDevice::motorsOff();
    times_off.fetch_add(1);
  }
  double last_N = 0.0, most_N = 0.0, last_Nmm = 0.0, most_Nmm = 0.0;  // read after stop()
  bool motors_on = false;
  std::atomic<int> times_off{0};

 private:
  int calls_ = 0, slow_at_;
  std::chrono::milliseconds slowness_;
  DeviceCapabilities capabilities_;
};

/// Until the servo has run that many ticks, however busy the machine is.
void waitForTick(Latest<Tick>& newest, std::uint64_t index) {
  for (int i = 0; i < 10'000 && newest.read().index < index; ++i) std::this_thread::sleep_for(2ms);
}

struct Bench {
  CarvedBone bone = halfSpace(4.0, 0.25).bone(1);
  Servo servo{bone};
  Latest<Command> commands;
  TickLog log;
  Latest<Tick> newest;
  LoopSettings settings = [] {
    LoopSettings s;
    s.realtime = false;
    return s;
  }();
};

TEST(HapticLoop, TicksLogsAndLetsGoWhenStopped) {
  Bench bench;
  PressedDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 30);
  loop.stop();
  std::vector<Tick> ticks;
  bench.log.drainInto(ticks);
  ASSERT_GT(ticks.size(), 10u);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].index, i);
  EXPECT_EQ(bench.newest.read().index, ticks.back().index);
  const LoopFigures figures = loop.figures();
  EXPECT_EQ(figures.ticks, ticks.size());
  EXPECT_GT(figures.work_p50_us, 0.0);
  EXPECT_LE(figures.work_p50_us, figures.work_p99_us);
  // The device's own limit binds, and the last thing it was told is no force.
  EXPECT_NEAR(device.most_N, 0.5, 1e-9);
  EXPECT_EQ(device.last_N, 0.0);
}

TEST(HapticLoop, ObeysNewCommands) {
  Bench bench;
  PressedDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  Command command;
  command.serial = 7;
  bench.commands.publish(command);
  for (int i = 0; i < 10'000 && bench.newest.read().command_serial != 7; ++i) std::this_thread::sleep_for(2ms);
  EXPECT_EQ(bench.newest.read().command_serial, 7u);
}

TEST(HapticLoop, CountsMissedDeadlinesAndGoesOn) {
  Bench bench;
  PressedDevice device(20);
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 60);
  loop.stop();
  EXPECT_GE(loop.figures().missed, 28u);
  EXPECT_GE(bench.newest.read().index, 60u);
}

TEST(HapticLoop, RefusesRatesAndPosesItCannotServe) {
  Bench bench;
  MouseDevice device;
  const auto make = [&](const LoopSettings& settings) {
    HapticLoop(bench.servo, device, bench.commands, bench.log, bench.newest, settings);
  };
  LoopSettings bad;
  bad.rate_Hz = 100.0;
  EXPECT_THROW(make(bad), DeviceError);
  bad = {};
  bad.X_PD.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make(bad), DeviceError);
  bad = {};
  bad.X_HT.rotation = glm::dquat(2.0, 0.0, 0.0, 0.0);
  EXPECT_THROW(make(bad), DeviceError);
}

TEST(HapticLoop, ServesTorqueAboutTheHandleToADeviceThatHasIt) {
  // The tool sticks out 60 mm to the side of the handle and is pressed with 0.5 N: 30 N mm, of which 20 are allowed.
  for (double peak_Nmm : {0.0, 20.0}) {
    Bench bench;
    PressedDevice device;
    device.setPeakTorque(peak_Nmm);
    bench.settings.X_HT.translation_mm = {60.0, 0.0, 0.0};
    bench.settings.X_PD.translation_mm = {-60.0, 0.0, 0.0};
    HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
    loop.start();
    waitForTick(bench.newest, 80);
    loop.stop();
    EXPECT_NEAR(device.most_Nmm, peak_Nmm, 1e-9);
    EXPECT_EQ(device.last_Nmm, 0.0);
  }
}

TEST(HapticLoop, RunsAtTenKilohertz) {
  Bench bench;
  bench.settings.rate_Hz = 10'000.0;
  PressedDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 1000);
  loop.stop();
  EXPECT_GE(loop.figures().ticks, 1000u);
  EXPECT_EQ(bench.newest.read().dt_s, 1e-4);
  EXPECT_NEAR(device.most_N, 0.5, 1e-9);
}

TEST(HapticLoop, SupervisorSwitchesTheMotorsOffWhenTicksStop) {
  Bench bench;
  PressedDevice device(20, 150ms);
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 60);
  EXPECT_GE(device.times_off.load(), 1);
  EXPECT_GE(loop.figures().silences, 1u);
  loop.stop();
}

/// Ticks when a test says so.
class TickedByHand final : public HapticDevice {
 public:
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void start(DeviceServo& servo, double) override { servo_ = &servo; }
  void stop() noexcept override {}
  void motorsOff() noexcept override {}
  double force_N(bool healthy = true) {
    HandleState state;
    state.X_DH.translation_mm = {0.0, 0.0, 1.0};
    state.healthy = healthy;
    return glm::length(servo_->tick(state, {}).wrench_D().force_N.xyz);
  }

 private:
  DeviceCapabilities capabilities_;
  DeviceServo* servo_ = nullptr;
};

TEST(HapticLoop, BringsNoForceBackToLetItDown) {
  for (bool after_a_pause : {true, false}) {
    Bench bench;
    TickedByHand device;
    HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
    loop.start();
    double before_N = 0.0;
    for (int i = 0; i < 50; ++i) before_N = device.force_N();
    ASSERT_GT(before_N, 0.5);
    std::thread stopping([&] { loop.stop(); });
    // Long enough for stop() to have begun, and for the supervisor to have switched off.
    std::this_thread::sleep_for(after_a_pause ? 100ms : 10ms);
    EXPECT_EQ(device.force_N(after_a_pause), 0.0) << (after_a_pause ? "after a pause" : "in trouble");
    EXPECT_EQ(device.force_N(), 0.0);
    stopping.join();
    EXPECT_EQ(device.force_N(), 0.0) << "stopped";
  }
}

TEST(HapticLoop, RemembersSilencesWhenItHasStopped) {
  Bench bench;
  PressedDevice device(20, 300ms);
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 40);
  loop.stop();
  EXPECT_GE(loop.figures().silences, 1u);
  loop.stop();
  EXPECT_GE(loop.figures().silences, 1u);
}

TEST(HapticLoop, GivesNoForceAfterAnEmergencyStopAndGoesOnTicking) {
  Bench bench;
  PressedDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 30);
  loop.emergencyStop();
  const std::uint64_t then = bench.newest.read().index;
  waitForTick(bench.newest, then + 20);
  loop.stop();
  EXPECT_EQ(device.last_N, 0.0);
  EXPECT_FALSE(device.motors_on);
}

TEST(HapticLoop, PushesNobodyWhoWasNotArmedAndDrillsNothing) {
  // In the bone from the first tick on, and with motors: somebody would be thrown.
  Bench bench;
  PressedDevice device;
  device.setMotors();
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 200);
  EXPECT_EQ(bench.newest.read().state, SafetyState::ready);
  loop.stop();
  EXPECT_EQ(device.most_N, 0.0);
}

TEST(HapticLoop, RecordsAnEmergencyStopSoThatAReplayStopsToo) {
  Bench bench;
  PressedDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  waitForTick(bench.newest, 30);
  loop.emergencyStop();
  waitForTick(bench.newest, bench.newest.read().index + 20);
  loop.stop();
  EXPECT_TRUE(bench.newest.read().hand.stop_asked);
  EXPECT_EQ(bench.newest.read().state, SafetyState::off);
  EXPECT_EQ(glm::length(bench.newest.read().served_force_P_N.xyz), 0.0);
}

TEST(LimitedTo, IsStrictWithADeviceThatHasMotorsWhateverWasAskedFor) {
  Command command;
  command.safety.slew_N_per_s = 1e5;
  command.safety.must_be_armed = false;
  command.safety.fastest_mm_per_s = 1e9;
  command.safety.thresholds.cut_mm_per_s = 1e9;
  command.law.damping_Ns_per_mm = 0.05;
  DeviceCapabilities device;
  device.most_stiffness_N_per_mm = 0.7;
  device.peak_joint_torque_Nmm = {350.0, 0.0, 300.0};
  EXPECT_FALSE(limitedTo(device, 1000.0, command).safety.must_be_armed);
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.continuous_force_N, 1e3) << "no motors, no heat";
  device.has_motors = true;
  const Command limited = limitedTo(device, 4000.0, command);
  EXPECT_TRUE(limited.safety.must_be_armed);
  EXPECT_EQ(limited.safety.slew_N_per_s, 300.0);
  EXPECT_EQ(limited.safety.fastest_mm_per_s, 2000.0);
  EXPECT_EQ(limited.safety.thresholds.cut_mm_per_s, 1000.0);
  EXPECT_EQ(limited.safety.peak_force_N, 0.9 * 3.3);
  EXPECT_EQ(limited.safety.continuous_force_N, 0.88);
  EXPECT_EQ(limited.law.damping_Ns_per_mm, 0.005);
  EXPECT_EQ(limited.safety.peak_joint_torque_Nmm, glm::dvec3(350.0, 0.0, 300.0));
  // Once is enough.
  EXPECT_EQ(limitedTo(device, 4000.0, limited).safety.peak_force_N, limited.safety.peak_force_N);
  command.law.damping_Ns_per_mm = 0.0;
  EXPECT_EQ(limitedTo(device, 4000.0, command).safety.most_stiffness_N_per_mm, 0.7);
}

TEST(LimitedTo, TakesTheSmallerPeaks) {
  Command command;
  DeviceCapabilities device;
  device.peak_force_N = 1.0;
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.peak_force_N, 1.0);
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.peak_torque_Nmm, 0.0);
  device.peak_force_N = 9.0;
  device.peak_torque_Nmm = 120.0;
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.peak_force_N, 3.3);
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.peak_torque_Nmm, 120.0);
  device.peak_force_N = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.peak_force_N, 0.0);
}

TEST(LimitedTo, AllowsNoSlopeThatTheDeviceCannotHold) {
  Command command;
  DeviceCapabilities device;  // b = 2 N s/m
  EXPECT_NEAR(limitedTo(device, 1000.0, command).safety.most_stiffness_N_per_mm, 3.6, 1e-12);
  EXPECT_NEAR(limitedTo(device, 4000.0, command).safety.most_stiffness_N_per_mm, 14.4, 1e-12);
  EXPECT_NEAR(limitedTo(device, 10'000.0, command).safety.most_stiffness_N_per_mm, 20.0, 1e-12);
  command.law.damping_Ns_per_mm = 0.001;
  EXPECT_NEAR(limitedTo(device, 1000.0, command).safety.most_stiffness_N_per_mm, 1.8, 1e-12);
  command.law.damping_Ns_per_mm = 0.003;
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.most_stiffness_N_per_mm, 0.0);
}

}  // namespace
}  // namespace haptics
