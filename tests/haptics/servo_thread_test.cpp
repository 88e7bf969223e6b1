#include "haptics/servo/servo_thread.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "haptics/device/mouse_device.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;
using namespace std::chrono_literals;

/// Stands still under the surface, remembers the force it is given, and can be slow once.
class PressedDevice final : public HapticDevice {
 public:
  explicit PressedDevice(int slow_at = -1) : slow_at_(slow_at) {}
  DeviceCapabilities capabilities() const override { return {0.5}; }
  HandleState exchange(const Vector<calibration::Device>& force_D_N, double) noexcept override {
    if (calls_++ == slow_at_) std::this_thread::sleep_for(30ms);
    last_N = glm::length(force_D_N.xyz);
    most_N = std::max(most_N, last_N);
    HandleState state;
    state.X_DH.translation_mm = {0.0, 0.0, 1.0};
    return state;
  }
  double last_N = 0.0, most_N = 0.0;  // read after stop()

 private:
  int calls_ = 0, slow_at_;
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
  ServoSettings settings = [] {
    ServoSettings s;
    s.realtime = false;
    return s;
  }();
};

TEST(ServoThread, TicksLogsAndLetsGoWhenStopped) {
  Bench bench;
  PressedDevice device;
  ServoThread thread(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  thread.start();
  waitForTick(bench.newest, 30);
  thread.stop();
  std::vector<Tick> ticks;
  bench.log.drainInto(ticks);
  ASSERT_GT(ticks.size(), 10u);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].index, i);
  EXPECT_EQ(bench.newest.read().index, ticks.back().index);
  const ServoFigures figures = thread.figures();
  EXPECT_EQ(figures.ticks, ticks.size());
  EXPECT_GT(figures.work_p50_us, 0.0);
  EXPECT_LE(figures.work_p50_us, figures.work_p99_us);
  // The device's own limit binds, and the last thing it was told is no force.
  EXPECT_NEAR(device.most_N, 0.5, 1e-9);
  EXPECT_EQ(device.last_N, 0.0);
}

TEST(ServoThread, ObeysNewCommands) {
  Bench bench;
  PressedDevice device;
  ServoThread thread(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  thread.start();
  Command command;
  command.serial = 7;
  bench.commands.publish(command);
  for (int i = 0; i < 10'000 && bench.newest.read().command_serial != 7; ++i) std::this_thread::sleep_for(2ms);
  EXPECT_EQ(bench.newest.read().command_serial, 7u);
}

TEST(ServoThread, CountsMissedDeadlinesAndGoesOn) {
  Bench bench;
  PressedDevice device(20);
  ServoThread thread(bench.servo, device, bench.commands, bench.log, bench.newest, bench.settings);
  thread.start();
  waitForTick(bench.newest, 60);
  thread.stop();
  EXPECT_GE(thread.figures().missed, 28u);
  EXPECT_GE(bench.newest.read().index, 60u);
}

TEST(ServoThread, RefusesRatesAndPosesItCannotServe) {
  Bench bench;
  MouseDevice device;
  const auto make = [&](const ServoSettings& settings) {
    ServoThread(bench.servo, device, bench.commands, bench.log, bench.newest, settings);
  };
  ServoSettings bad;
  bad.rate_Hz = 100.0;
  EXPECT_THROW(make(bad), DeviceError);
  bad = {};
  bad.X_PD.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make(bad), DeviceError);
  bad = {};
  bad.X_HT.rotation = glm::dquat(2.0, 0.0, 0.0, 0.0);
  EXPECT_THROW(make(bad), DeviceError);
}

TEST(LimitedTo, TakesTheSmallerPeak) {
  Command command;
  EXPECT_EQ(limitedTo({1.0}, command).safety.peak_force_N, 1.0);
  EXPECT_EQ(limitedTo({9.0}, command).safety.peak_force_N, 3.3);
  EXPECT_EQ(limitedTo({std::numeric_limits<double>::quiet_NaN()}, command).safety.peak_force_N, 0.0);
}

}  // namespace
}  // namespace haptics
