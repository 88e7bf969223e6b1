#include "haptics/loop/instrument_tracker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "haptics/device/simulated_device.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Shows what the test says, and counts what it is told.
class ShownDevice final : public SimulatedDevice {
 public:
  ShownDevice() { capabilities_.has_motors = true; }
  ~ShownDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>&, double) noexcept override { return shown; }

  HandleState shown;
  int drives = 0, pushes = 0;

 protected:
  void drive(const MotorCommand& command) noexcept override {
    const auto& wrench = command.wrench_D();
    const bool is_nothing = glm::length(wrench.force_N.xyz) == 0.0 && glm::length(wrench.torque_Nmm.xyz) == 0.0;
    if (command.motorsOn() || !is_nothing) ++pushes;
    ++drives;
  }

 private:
  DeviceCapabilities capabilities_;
};

HandleState at(double x_mm) {
  HandleState state;
  state.X_DH.translation_mm.x = x_mm;
  return state;
}

/// A hand that is stepped, and its device.
struct Stepped {
  ShownDevice device;
  InstrumentTracker hand{ServedDevice::steppedManually(device), 1000.0};
  Stepped() { hand.start(); }

  void show(const HandleState& state, std::uint64_t ticks) {
    device.shown = state;
    hand.step(ticks);
  }
};

TEST(InstrumentTracker, IsNeverToldAForceAndKeepsItsMotorsOff) {
  Stepped stepped;
  EXPECT_TRUE(stepped.hand.isForceDisabled());
  HandleState pressed = at(3.0);
  pressed.velocity_D_mm_per_s.xyz = {1e4, -1e4, 0.0};
  pressed.jacobian_D_mm = glm::dmat3(100.0);
  pressed.pedal = pressed.held = true;
  pressed.buttons = ~0u;
  HandleState mad = pressed;
  mad.X_DH.translation_mm = glm::dvec3(kNan);
  mad.jacobian_D_mm = glm::dmat3(kNan);
  for (const HandleState& state : {HandleState{}, pressed, mad, pressed}) stepped.show(state, 20);
  stepped.hand.stop();
  EXPECT_GE(stepped.device.drives, 80);
  EXPECT_EQ(stepped.device.pushes, 0);
}

TEST(InstrumentTracker, BringsTheNewestPose) {
  Stepped stepped;
  EXPECT_FALSE(stepped.hand.newest()) << "nothing was measured yet";
  for (double x_mm = 1.0; x_mm < 40.0; x_mm += 1.0) {
    stepped.show(at(x_mm), 3);
    ASSERT_TRUE(stepped.hand.newest());
    EXPECT_EQ(stepped.hand.newest()->X_DH.translation_mm.x, x_mm);
  }
  EXPECT_EQ(stepped.hand.dropouts(), 0u);
}

TEST(InstrumentTracker, KeepsTheLastPoseOverOneThatIsNone) {
  std::vector<HandleState> bad(5, at(9.0));
  bad[0].X_DH.translation_mm.y = kNan;
  bad[1].X_DH.translation_mm.z = std::numeric_limits<double>::infinity();
  bad[2].X_DH.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0);
  bad[3].X_DH.rotation = glm::dquat(kNan, 0.0, 0.0, 0.0);
  bad[4].calibrated = false;
  for (const HandleState& state : bad) {
    Stepped stepped;
    stepped.show(at(5.0), 1);
    stepped.show(state, 400);
    ASSERT_TRUE(stepped.hand.newest()) << "0.4 s of doubt";
    EXPECT_EQ(stepped.hand.newest()->X_DH.translation_mm.x, 5.0);
    EXPECT_EQ(stepped.hand.dropouts(), 1u) << "one trouble, however many ticks it lasts";
    stepped.show(at(6.0), 1);
    ASSERT_TRUE(stepped.hand.newest());
    EXPECT_EQ(stepped.hand.newest()->X_DH.translation_mm.x, 6.0);
  }
}

TEST(InstrumentTracker, ForgetsAnUnpluggedDeviceUntilItIsBack) {
  Stepped stepped;
  stepped.show(at(5.0), 1);
  HandleState gone = at(5.0);
  gone.healthy = false;
  stepped.show(gone, 499);
  EXPECT_TRUE(stepped.hand.newest());
  stepped.show(gone, 2);
  EXPECT_FALSE(stepped.hand.newest()) << "half a second";
  EXPECT_EQ(stepped.hand.dropouts(), 1u);
  stepped.show(at(7.0), 1);
  EXPECT_TRUE(stepped.hand.newest());
  stepped.show(gone, 1);
  EXPECT_EQ(stepped.hand.dropouts(), 2u);
  stepped.hand.stop();
  EXPECT_EQ(stepped.device.pushes, 0);
}

TEST(InstrumentTracker, ForgetsADeviceThatHangs) {
  Stepped stepped;
  stepped.show(at(5.0), 1);
  ASSERT_TRUE(stepped.hand.newest());
  stepped.hand.pass(499ms);
  EXPECT_TRUE(stepped.hand.newest());
  stepped.hand.pass(2ms);
  EXPECT_FALSE(stepped.hand.newest());
  stepped.hand.step(1);
  EXPECT_TRUE(stepped.hand.newest());
}

TEST(InstrumentTracker, StopsForGoodAndTwice) {
  {
    Stepped stepped;
    stepped.hand.step(3);
    stepped.hand.stop();
    const int drives = stepped.device.drives;
    stepped.hand.step(20);
    EXPECT_EQ(stepped.device.drives, drives);
    stepped.hand.stop();
    EXPECT_EQ(stepped.device.drives, drives);
  }
  ShownDevice device;
  InstrumentTracker never_started(device, 1000.0);
  EXPECT_FALSE(never_started.newest());
  EXPECT_THROW(InstrumentTracker(device, 100.0), DeviceError);
}

}  // namespace
}  // namespace haptics
