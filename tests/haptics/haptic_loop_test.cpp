#include "haptics/servo/haptic_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "calibration/geometry/units.h"
#include "haptics/device/simulated/mouse_device.h"
#include "haptics/device/simulated/replay_device.h"
#include "haptics/device/simulated_device.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using namespace std::chrono_literals;

/// Stands still under the surface and remembers what its motors are told.
class PressedDevice : public SimulatedDevice {
 public:
  PressedDevice() { capabilities_.peak_force_N = 0.5; }
  ~PressedDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void setMotors() { capabilities_.has_motors = true; }
  void setPeakTorque(double peak_Nmm) { capabilities_.peak_torque_Nmm = peak_Nmm; }

  HandleState exchange(const Wrench<calibration::Device>&, double) noexcept override { return state; }
  void drive(const MotorCommand& command) noexcept override {
    last_N = glm::length(command.wrench_D().force_N.xyz);
    last_Nmm = glm::length(command.wrench_D().torque_Nmm.xyz);
    told_N.push_back(last_N);
    most_Nmm = std::max(most_Nmm, last_Nmm);
    most_N = std::max(most_N, last_N);
    motors_on = command.motorsOn();
  }

  HandleState state = [] {
    HandleState pressed;
    pressed.X_DH.translation_mm = {0.0, 0.0, 1.0};
    return pressed;
  }();
  std::vector<double> told_N;
  double last_N = 0.0, most_N = 0.0, last_Nmm = 0.0, most_Nmm = 0.0;
  bool motors_on = false;

 private:
  DeviceCapabilities capabilities_;
};

/// On its own thread: hangs in a tick until somebody switches its motors off.
class HangingDevice final : public PressedDevice {
 public:
  ~HangingDevice() override { stop(); }
  void drive(const MotorCommand& command) noexcept override {
    PressedDevice::drive(command);
    std::unique_lock lock(mutex_);
    changed_.notify_all();
    if (++calls_ == 20) changed_.wait_for(lock, 60s, [this] { return times_off_ > 0; });
  }
  void motorsOff() noexcept override {
    PressedDevice::motorsOff();
    const std::scoped_lock lock(mutex_);
    ++times_off_;
    changed_.notify_all();
  }
  /// False when that takes a minute.
  bool awaitCalls(int calls) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 60s, [&] { return calls_ >= calls; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int calls_ = 0, times_off_ = 0;
};

struct Bench {
  Bodies bone = halfSpace(4.0, 0.25).bodies(1);
  Servo servo{bone};
  Latest<Command> commands;
  TickLog log;
  Latest<Tick> newest;
  LoopSettings settings = [] {
    LoopSettings s;
    s.priority = std::nullopt;
    return s;
  }();

  /// Started; ticks when it is stepped.
  std::unique_ptr<HapticLoop> byHand(SimulatedDevice& device) {
    auto loop =
        std::make_unique<HapticLoop>(servo, ServedDevice::steppedManually(device), commands, log, newest, settings);
    loop->start();
    return loop;
  }
};

TEST(HapticLoop, TicksLogsAndLetsGoWhenStopped) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(30);
  loop->stop();
  std::vector<Tick> ticks;
  bench.log.drainInto(ticks);
  ASSERT_EQ(ticks.size(), 30u);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].index, i);
  EXPECT_EQ(bench.newest.read().index, ticks.back().index);
  EXPECT_EQ(loop->figures().ticks, ticks.size());
  // The device's own limit binds, and the last thing it was told is no force.
  EXPECT_NEAR(device.most_N, 0.5, 1e-9);
  EXPECT_EQ(device.last_N, 0.0);
}

TEST(HapticLoop, TicksOnTheDevicesOwnThreadToo) {
  Bench bench;
  HangingDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  ASSERT_TRUE(device.awaitCalls(15));
  loop.stop();
  std::vector<Tick> ticks;
  bench.log.drainInto(ticks);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].index, i);
  const LoopFigures figures = loop.figures();
  EXPECT_EQ(figures.ticks, ticks.size());
  EXPECT_GT(figures.work_p50_us, 0.0);
  EXPECT_LE(figures.work_p50_us, figures.work_p99_us);
  EXPECT_EQ(device.last_N, 0.0);
}

TEST(HapticLoop, LetsTheForceDownGraduallyWhenStopped) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(50);
  const std::size_t before = device.told_N.size();
  ASSERT_NEAR(device.last_N, 0.5, 1e-9);
  loop->stop();
  for (std::size_t i = before; i < device.told_N.size(); ++i) {
    EXPECT_LE(device.told_N[i], device.told_N[i - 1]);
    EXPECT_GE(device.told_N[i], device.told_N[i - 1] - 0.3 - 1e-9) << "300 N/s";
  }
  EXPECT_GT(device.told_N[before], 0.0);
}

TEST(HapticLoop, ByHandTakesNoTimeFromTheMachine) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(200);
  std::vector<Tick> ticks;
  bench.log.drainInto(ticks);
  ASSERT_EQ(ticks.size(), 200u);
  for (const Tick& tick : ticks) {
    EXPECT_EQ(tick.work_us, 0.0f);
    EXPECT_EQ(tick.hand.gap_s, 0.0);
  }
  const LoopFigures figures = loop->figures();
  EXPECT_EQ(figures.missed, 0u);
  EXPECT_EQ(figures.late_max_us, 0.0);
  EXPECT_EQ(figures.work_max_us, 0.0);
  EXPECT_EQ(figures.watchdog_trips, 0u);
  loop->stop();
}

TEST(HapticLoop, ObeysNewCommandsFromTheVeryNextTick) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(5);
  Command command;
  command.serial = 7;
  bench.commands.publish(command);
  EXPECT_NE(bench.newest.read().command_serial, 7u);
  loop->step(1);
  EXPECT_EQ(bench.newest.read().command_serial, 7u);
  loop->stop();
}

TEST(HapticLoop, CountsMissedDeadlinesAndGoesOn) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(20);
  loop->pass(30ms);  // 29 deadlines and a late one
  loop->step(1);
  EXPECT_NEAR(bench.newest.read().hand.gap_s, 0.030, 1e-12);
  EXPECT_NEAR(loop->figures().late_max_us, 29'000.0, 1e-6);
  loop->step(1);
  EXPECT_EQ(loop->figures().missed, 29u);
  EXPECT_EQ(bench.newest.read().hand.gap_s, 0.0) << "back on the grid";
  loop->step(20);
  EXPECT_EQ(loop->figures().missed, 29u);
  EXPECT_EQ(loop->figures().ticks, 42u);
  loop->stop();
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

TEST(HapticLoop, ByHandEndsWhereTheDeviceRefusesItsRateOrIsGone) {
  Bench bench;
  bench.settings.rate_Hz = 2000.0;
  ReplayDevice recorded_at_1_kHz({HandleState{}}, 0.001);
  {
    HapticLoop loop(bench.servo, ServedDevice::steppedManually(recorded_at_1_kHz), bench.commands, bench.log,
                    bench.newest, bench.settings);
    EXPECT_THROW(loop.start(), DeviceError);
    loop.stop();
  }
  PressedDevice device;
  const auto loop = bench.byHand(device);
  device.stop();
  loop->stop();
}

TEST(HapticLoop, ServesTorqueAboutTheHandleToADeviceThatHasIt) {
  // The tool sticks out 60 mm to the side of the handle and is pressed with 0.5 N: 30 N mm, of which 20 are allowed.
  for (double peak_Nmm : {0.0, 20.0}) {
    Bench bench;
    PressedDevice device;
    device.setPeakTorque(peak_Nmm);
    bench.settings.X_HT.translation_mm = {60.0, 0.0, 0.0};
    bench.settings.X_PD.translation_mm = {-60.0, 0.0, 0.0};
    const auto loop = bench.byHand(device);
    loop->step(80);
    loop->stop();
    EXPECT_NEAR(device.most_Nmm, peak_Nmm, 1e-9);
    EXPECT_EQ(device.last_Nmm, 0.0);
  }
}

TEST(HapticLoop, RunsAtTenKilohertz) {
  Bench bench;
  bench.settings.rate_Hz = 10'000.0;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(1000);
  EXPECT_EQ(loop->figures().ticks, 1000u);
  EXPECT_EQ(bench.newest.read().dt_s, 1e-4);
  EXPECT_NEAR(device.most_N, 0.5, 1e-9);
  loop->stop();
}

TEST(HapticLoop, SupervisorSwitchesTheMotorsOffWhenTicksStop) {
  Bench bench;
  HangingDevice device;
  HapticLoop loop(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  loop.start();
  // Goes on only once its motors were switched off.
  ASSERT_TRUE(device.awaitCalls(25));
  loop.stop();
  EXPECT_GE(loop.figures().watchdog_trips, 1u) << "remembered when it has stopped";
  loop.stop();
  EXPECT_GE(loop.figures().watchdog_trips, 1u);
}

TEST(HapticLoop, BringsNoForceBackToLetItDown) {
  for (bool after_a_pause : {true, false}) {
    Bench bench;
    PressedDevice device;
    const auto loop = bench.byHand(device);
    loop->step(50);
    const std::size_t before = device.told_N.size();
    ASSERT_NEAR(device.last_N, 0.5, 1e-9);
    if (after_a_pause) loop->pass(100ms);
    device.state.healthy = after_a_pause;
    loop->stop();
    for (std::size_t i = before; i < device.told_N.size(); ++i)
      EXPECT_EQ(device.told_N[i], 0.0) << (after_a_pause ? "after a pause" : "in trouble");
  }
}

TEST(HapticLoop, GivesNoForceAfterAnEmergencyStopAndGoesOnTicking) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(30);
  ASSERT_GT(device.last_N, 0.0);
  loop->emergencyStop();
  loop->step(1);
  EXPECT_EQ(device.last_N, 0.0);
  loop->step(20);
  EXPECT_EQ(bench.newest.read().index, 50u);
  EXPECT_EQ(device.last_N, 0.0);
  EXPECT_FALSE(device.motors_on);
  loop->stop();
}

TEST(HapticLoop, PushesNobodyWhoWasNotArmedAndDrillsNothing) {
  // In the bone from the first tick on, and with motors: somebody would be thrown.
  Bench bench;
  PressedDevice device;
  device.setMotors();
  const auto loop = bench.byHand(device);
  loop->step(200);
  EXPECT_EQ(bench.newest.read().state, SafetyState::ready);
  loop->stop();
  EXPECT_EQ(device.most_N, 0.0);
}

TEST(HapticLoop, TakesUpAFileWithItsTipWhereTheBurWasAndJumpsNoHand) {
  Bench bench;
  bench.settings.held_by_end = true;
  bench.settings.X_HT.translation_mm = {0.0, 0.0, -40.0};
  PressedDevice device;
  // On its side: the instrument lies along y, off the bone.
  device.state.X_DH = {glm::angleAxis(0.5 * calibration::kPi, glm::dvec3(1.0, 0.0, 0.0)), {1.0, 2.0, 30.0}};
  const auto loop = bench.byHand(device);
  loop->step(30);
  const glm::dvec3 bur_P_mm = bench.newest.read().hand.X_PT.translation_mm;
  Command file;
  file.serial = 1;
  file.tool = fileTool({.size = 20, .length_mm = 25.0});
  bench.commands.publish(file);
  for (int n = 0; n < 30; ++n) {
    loop->step(1);
    const Tick tick = bench.newest.read();
    EXPECT_LT(glm::distance(tick.file.tip_P_mm, bur_P_mm), 1e-4);
    EXPECT_NEAR(glm::distance(glm::dvec3(tick.file.node_P_mm.front()), bur_P_mm), 25.0, 1e-4);
    EXPECT_LT(glm::length(tick.hand.velocity_P_mm_per_s.xyz), 1e-9) << "of no motion";
    EXPECT_EQ(tick.faults, Fault::none);
  }
  // A bur again, where the tip was.
  Command bur;
  bur.serial = 2;
  bench.commands.publish(bur);
  loop->step(1);
  EXPECT_LT(glm::distance(bench.newest.read().hand.X_PT.translation_mm, bur_P_mm), 1e-9);
  EXPECT_EQ(device.most_N, 0.0);
  loop->stop();
}

TEST(HapticLoop, RecordsAnEmergencyStopSoThatAReplayStopsToo) {
  Bench bench;
  PressedDevice device;
  const auto loop = bench.byHand(device);
  loop->step(30);
  loop->emergencyStop();
  loop->step(20);
  EXPECT_TRUE(bench.newest.read().hand.stop_requested);
  EXPECT_EQ(bench.newest.read().state, SafetyState::off);
  EXPECT_EQ(glm::length(bench.newest.read().commanded_force_P_N.xyz), 0.0);
  loop->stop();
}

TEST(LimitedTo, IsStrictWithADeviceThatHasMotorsWhateverWasAskedFor) {
  Command command;
  command.safety.slew_N_per_s = 1e5;
  command.safety.must_be_armed = false;
  command.safety.max_speed_mm_per_s = 1e9;
  command.safety.thresholds.cutoff_mm_per_s = 1e9;
  command.law.damping_Ns_per_mm = 0.05;
  DeviceCapabilities device;
  device.max_stiffness_N_per_mm = 0.7;
  device.peak_joint_torque_Nmm = {350.0, 0.0, 300.0};
  EXPECT_FALSE(limitedTo(device, 1000.0, command).safety.must_be_armed);
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.continuous_force_N, 1e3) << "no motors, no heat";
  device.has_motors = true;
  const Command limited = limitedTo(device, 4000.0, command);
  EXPECT_TRUE(limited.safety.must_be_armed);
  EXPECT_EQ(limited.safety.slew_N_per_s, 300.0);
  EXPECT_EQ(limited.safety.max_speed_mm_per_s, 2000.0);
  EXPECT_EQ(limited.safety.thresholds.cutoff_mm_per_s, 1000.0);
  EXPECT_EQ(limited.safety.peak_force_N, 0.9 * 3.3);
  EXPECT_EQ(limited.safety.continuous_force_N, 0.88);
  EXPECT_EQ(limited.law.damping_Ns_per_mm, 0.005);
  EXPECT_EQ(limited.safety.peak_joint_torque_Nmm, glm::dvec3(350.0, 0.0, 300.0));
  // Once is enough.
  EXPECT_EQ(limitedTo(device, 4000.0, limited).safety.peak_force_N, limited.safety.peak_force_N);
  command.law.damping_Ns_per_mm = 0.0;
  EXPECT_EQ(limitedTo(device, 4000.0, command).safety.max_stiffness_N_per_mm, 0.7);
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
  EXPECT_NEAR(limitedTo(device, 1000.0, command).safety.max_stiffness_N_per_mm, 3.6, 1e-12);
  EXPECT_NEAR(limitedTo(device, 4000.0, command).safety.max_stiffness_N_per_mm, 14.4, 1e-12);
  EXPECT_NEAR(limitedTo(device, 10'000.0, command).safety.max_stiffness_N_per_mm, 20.0, 1e-12);
  command.law.damping_Ns_per_mm = 0.001;
  EXPECT_NEAR(limitedTo(device, 1000.0, command).safety.max_stiffness_N_per_mm, 1.8, 1e-12);
  command.law.damping_Ns_per_mm = 0.003;
  EXPECT_EQ(limitedTo(device, 1000.0, command).safety.max_stiffness_N_per_mm, 0.0);
}

}  // namespace
}  // namespace haptics
