#include "app/device/check/constant_force_loop.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "app/device/check/simulated_owner.h"
#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/device/simulated_device.h"

namespace app {
namespace {

/// Stands still and remembers the largest force and the last word.
class StillDevice final : public haptics::SimulatedDevice {
 public:
  StillDevice() {
    can_.has_motors = true;
    can_.peak_force_N = 3.3;
  }
  ~StillDevice() override { stop(); }
  const haptics::DeviceCapabilities& capabilities() const override { return can_; }
  haptics::HandleState exchange(const haptics::Wrench<calibration::Device>&, double) noexcept override {
    haptics::HandleState state;
    state.docked = docked;
    return state;
  }
  void drive(const haptics::MotorCommand& command) noexcept override {
    last_N = glm::length(command.wrench_D().force_N.xyz);
    most_N = std::max(most_N, last_N);
    steepest_N = std::max(steepest_N, last_N - before_N_);
    before_N_ = last_N;
    motors_on = command.motorsOn();
  }
  double last_N = 0.0, most_N = 0.0, steepest_N = 0.0;
  bool docked = false, motors_on = true;

 private:
  haptics::DeviceCapabilities can_;
  double before_N_ = 0.0;
};

/// Within three seconds of its time.
template <class Condition>
bool eventually(ConstantForceLoop& hand, Condition condition) {
  for (int i = 0; i < 3000 && !condition(); ++i) hand.step(1);
  return condition();
}

TEST(ConstantForceLoop, DeliversTheRequestedForceWithinEveryLimitAndEndsWithMotorsOff) {
  StillDevice device;
  {
    ConstantForceLoop hand(haptics::ServedDevice::steppedManually(device), 1000.0);
    hand.start();
    hand.push({0.0, -0.6, 0.0});
    EXPECT_TRUE(
        eventually(hand, [&] { return glm::length(hand.newest().lately_D_N - glm::dvec3(0.0, -0.6, 0.0)) < 0.01; }));
    hand.push({50.0, 0.0, 0.0});
    EXPECT_TRUE(eventually(hand, [&] { return hand.newest().pushed_D_N.x > 0.8; }));
    hand.push({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    EXPECT_TRUE(eventually(hand, [&] { return glm::length(hand.newest().pushed_D_N) == 0.0; }));
    hand.stop();
  }
  EXPECT_LE(device.most_N, 0.9 * 3.3 + 1e-9);
  EXPECT_LE(device.steepest_N, 0.3 + 1e-9) << "no faster than 300 N/s";
  EXPECT_EQ(device.last_N, 0.0);
  EXPECT_FALSE(device.motors_on);
}

TEST(ConstantForceLoop, HasNoForceWhileTheHandleIsInItsInkwell) {
  StillDevice device;
  device.docked = true;
  ConstantForceLoop hand(haptics::ServedDevice::steppedManually(device), 1000.0);
  hand.start();
  hand.push({0.0, 1.0, 0.0});
  hand.step(200);
  EXPECT_EQ(device.most_N, 0.0);
  EXPECT_TRUE(hand.newest().state.docked);
  device.docked = false;
  EXPECT_TRUE(eventually(hand, [&] { return hand.newest().pushed_D_N.y > 0.8; }));
}

TEST(SimulatedOwner, PerformsItsTasksWithinTheSpeedLimit) {
  const haptics::PhantomMechanics& omni = *haptics::findSimulatedPhantom("omni");
  SimulatedOwner hand(omni);
  const haptics::HandScript script = hand.script();
  haptics::HandTarget last = script(0.0);
  EXPECT_EQ(last.position_mm, omni.rest_DH().translation_mm);
  double t_s = 0.0;
  const auto run = [&](double seconds) {
    for (const double until_s = t_s + seconds; t_s < until_s; t_s += 0.001) {
      const haptics::HandTarget next = script(t_s);
      EXPECT_LE(glm::length(next.position_mm - last.position_mm), 0.25 + 1e-9);
      last = next;
    }
  };
  hand.perform(OwnerTask::upper_corner);
  run(4.0);
  const glm::dvec3 upper_mm = last.position_mm;
  hand.perform(OwnerTask::lower_corner);
  run(4.0);
  EXPECT_TRUE(glm::all(glm::greaterThan(upper_mm - last.position_mm, glm::dvec3(20.0))));
  hand.perform(OwnerTask::second_button);
  run(0.01);
  EXPECT_EQ(last.buttons, 2u);
  hand.perform(OwnerTask::let_go);
  run(0.01);
  EXPECT_FALSE(last.grips);
}

}  // namespace
}  // namespace app
