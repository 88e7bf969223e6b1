#include "haptics/loop/handle_recorder.h"

#include <gtest/gtest.h>

#include <vector>

#include "haptics/device/simulated_device.h"

namespace haptics {
namespace {

/// Counts its ticks where its handle is.
class CountingDevice final : public SimulatedDevice {
 public:
  CountingDevice() { capabilities_.has_motors = true; }
  ~CountingDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<calibration::Device>&, double) noexcept override {
    HandleState state;
    state.X_DH.translation_mm.x = ++ticks_;
    state.calibrated = false;
    return state;
  }
  int pushes = 0;

 protected:
  void drive(const MotorCommand& command) noexcept override { pushes += command.motorsOn() ? 1 : 0; }

 private:
  double ticks_ = 0.0;
  DeviceCapabilities capabilities_;
};

TEST(SpscRing, KeepsTheOrderAndDropsTheNewestWhenFull) {
  SpscRing<TimedHandle> log(3);
  for (int n = 0; n < 5; ++n) log.push({.t_s = 1.0 * n, .state = {}});
  std::vector<TimedHandle> taken;
  log.drainInto(taken);
  ASSERT_EQ(taken.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(taken[n].t_s, static_cast<double>(n));
  EXPECT_EQ(log.dropped(), 2u);
  log.push({.t_s = 9.0, .state = {}});
  log.drainInto(taken);
  EXPECT_EQ(taken.back().t_s, 9.0);
}

TEST(HandleRecorder, BringsEveryTickOnceInOrderAndNeverAForce) {
  CountingDevice device;
  HandleRecorder hand(ServedDevice::steppedManually(device), 1000.0);
  hand.start();
  std::vector<TimedHandle> taken;
  for (int n = 0; n < 20; ++n) {
    hand.step(10);
    hand.takeInto(taken);
  }
  hand.stop();
  ASSERT_EQ(taken.size(), 200u);
  for (std::size_t n = 0; n < taken.size(); ++n) {
    EXPECT_EQ(taken[n].state.X_DH.translation_mm.x, static_cast<double>(n + 1));  // also invalid poses
    EXPECT_NEAR(taken[n].t_s, 1e-3 * static_cast<double>(n + 1), 1e-12);
  }
  EXPECT_EQ(hand.dropped(), 0u);
  EXPECT_EQ(device.pushes, 0);
}

}  // namespace
}  // namespace haptics
