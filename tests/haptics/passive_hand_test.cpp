#include "haptics/loop/passive_hand.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "haptics/device/paced_device.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Shows what the test says, and remembers what it is told.
class ShownDevice final : public PacedDevice {
 public:
  ShownDevice() { capabilities_.has_motors = true; }
  ~ShownDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }

  void show(const HandleState& state) { shown_.publish(state); }
  std::atomic<bool> hangs{false};
  std::atomic<int> drives{0}, pushes{0};

 protected:
  HandleState sense(double) noexcept override {
    while (hangs.load()) std::this_thread::sleep_for(1ms);
    return shown_.read();
  }
  void drive(const MotorCommand& command) noexcept override {
    const auto& wrench = command.wrench_D();
    const bool is_nothing = glm::length(wrench.force_N.xyz) == 0.0 && glm::length(wrench.torque_Nmm.xyz) == 0.0;
    if (command.motorsOn() || !is_nothing) pushes.fetch_add(1);
    drives.fetch_add(1);
  }

 private:
  Latest<HandleState> shown_;
  DeviceCapabilities capabilities_;
};

HandleState at(double x_mm) {
  HandleState state;
  state.X_DH.translation_mm.x = x_mm;
  return state;
}

/// However busy the machine is.
bool soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 20'000 && !holds(); ++i) std::this_thread::sleep_for(1ms);
  return holds();
}

void expectTicks(const PassiveHand& hand, std::uint64_t more) {
  const std::uint64_t from = hand.ticks();
  EXPECT_TRUE(soon([&] { return hand.ticks() >= from + more; }));
}

TEST(PassiveHand, IsNeverToldAForceAndKeepsItsMotorsOff) {
  ShownDevice device;
  PassiveHand hand(device, 1000.0);
  EXPECT_TRUE(hand.isForbidden());
  hand.start();
  HandleState pressed = at(3.0);
  pressed.velocity_D_mm_per_s.xyz = {1e4, -1e4, 0.0};
  pressed.jacobian_D_mm = glm::dmat3(100.0);
  pressed.pedal = pressed.held = true;
  pressed.buttons = ~0u;
  HandleState mad = pressed;
  mad.X_DH.translation_mm = glm::dvec3(kNan);
  mad.jacobian_D_mm = glm::dmat3(kNan);
  for (const HandleState& state : {HandleState{}, pressed, mad, pressed}) {
    device.show(state);
    expectTicks(hand, 20);
  }
  hand.stop();
  EXPECT_GT(device.drives.load(), 60);
  EXPECT_EQ(device.pushes.load(), 0);
}

TEST(PassiveHand, BringsTheNewestPose) {
  ShownDevice device;
  PassiveHand hand(device, 1000.0);
  EXPECT_FALSE(hand.newest()) << "nothing was measured yet";
  device.show(at(1.0));
  hand.start();
  EXPECT_TRUE(soon([&] { return hand.newest().has_value(); }));
  double last_mm = 1.0;
  for (double x_mm = 2.0; x_mm < 40.0; x_mm += 1.0) {
    device.show(at(x_mm));
    expectTicks(hand, 1);
    const auto newest = hand.newest();
    ASSERT_TRUE(newest);
    EXPECT_GE(newest->X_DH.translation_mm.x, last_mm);
    last_mm = newest->X_DH.translation_mm.x;
  }
  EXPECT_TRUE(soon([&] { return hand.newest()->X_DH.translation_mm.x == 39.0; }));
  EXPECT_EQ(hand.troubles(), 0u);
}

TEST(PassiveHand, KeepsTheLastPoseOverOneThatIsNone) {
  std::vector<HandleState> bad(5, at(9.0));
  bad[0].X_DH.translation_mm.y = kNan;
  bad[1].X_DH.translation_mm.z = std::numeric_limits<double>::infinity();
  bad[2].X_DH.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0);
  bad[3].X_DH.rotation = glm::dquat(kNan, 0.0, 0.0, 0.0);
  bad[4].calibrated = false;
  for (const HandleState& state : bad) {
    ShownDevice device;
    PassiveHand hand(device, 1000.0);
    device.show(at(5.0));
    hand.start();
    ASSERT_TRUE(soon([&] { return hand.newest().has_value(); }));
    device.show(state);
    ASSERT_TRUE(soon([&] { return hand.troubles() == 1; }));
    // Not long enough for it to be given up; on a busy machine it may be.
    EXPECT_EQ(hand.newest().value_or(at(5.0)).X_DH.translation_mm.x, 5.0);
    expectTicks(hand, 5);
    EXPECT_EQ(hand.troubles(), 1u) << "one trouble, however many ticks it lasts";
    device.show(at(6.0));
    EXPECT_TRUE(soon([&] {
      const auto newest = hand.newest();
      return newest && newest->X_DH.translation_mm.x == 6.0;
    }));
  }
}

TEST(PassiveHand, ForgetsAnUnpluggedDeviceUntilItIsBack) {
  ShownDevice device;
  PassiveHand hand(device, 1000.0);
  device.show(at(5.0));
  hand.start();
  ASSERT_TRUE(soon([&] { return hand.newest().has_value(); }));
  HandleState gone = at(5.0);
  gone.healthy = false;
  device.show(gone);
  EXPECT_TRUE(soon([&] { return !hand.newest(); }));
  EXPECT_EQ(hand.troubles(), 1u);
  device.show(at(7.0));
  EXPECT_TRUE(soon([&] { return hand.newest().has_value(); }));
  device.show(gone);
  EXPECT_TRUE(soon([&] { return hand.troubles() == 2; }));
  hand.stop();
  EXPECT_EQ(device.pushes.load(), 0);
}

TEST(PassiveHand, ForgetsADeviceThatHangs) {
  ShownDevice device;
  PassiveHand hand(device, 1000.0);
  device.show(at(5.0));
  hand.start();
  ASSERT_TRUE(soon([&] { return hand.newest().has_value(); }));
  device.hangs = true;
  EXPECT_TRUE(soon([&] { return !hand.newest(); }));
  EXPECT_TRUE(soon([&] { return hand.figures().silences > 0; }));
  device.hangs = false;
  EXPECT_TRUE(soon([&] { return hand.newest().has_value(); }));
}

TEST(PassiveHand, StopsForGoodAndTwice) {
  ShownDevice device;
  {
    PassiveHand hand(device, 1000.0);
    hand.start();
    expectTicks(hand, 3);
    hand.stop();
    const int drives = device.drives.load();
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(device.drives.load(), drives);
    hand.stop();
  }
  PassiveHand never_started(device, 1000.0);
  EXPECT_FALSE(never_started.newest());
  EXPECT_THROW(PassiveHand(device, 100.0), DeviceError);
}

}  // namespace
}  // namespace haptics
