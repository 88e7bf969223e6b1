#include "haptics/loop/listened_hand.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "haptics/device/paced_device.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// Counts its ticks where its handle is.
class CountingDevice final : public PacedDevice {
 public:
  CountingDevice() { capabilities_.has_motors = true; }
  ~CountingDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  std::atomic<int> pushes{0};

 protected:
  HandleState sense(double) noexcept override {
    HandleState state;
    state.X_DH.translation_mm.x = ++ticks_;
    state.calibrated = false;
    return state;
  }
  void drive(const MotorCommand& command) noexcept override { pushes.fetch_add(command.motorsOn() ? 1 : 0); }

 private:
  double ticks_ = 0.0;
  DeviceCapabilities capabilities_;
};

TEST(HandleLog, KeepsTheOrderAndDropsTheNewestWhenItIsFull) {
  HandleLog log(3);
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

TEST(ListenedHand, BringsEveryTickOnceInOrderAndNeverAForce) {
  CountingDevice device;
  ListenedHand hand(device, 1000.0);
  hand.start();
  std::vector<TimedHandle> taken;
  for (int n = 0; n < 20'000 && taken.size() < 200; ++n) {
    hand.takeInto(taken);
    std::this_thread::sleep_for(1ms);
  }
  hand.stop();
  ASSERT_GE(taken.size(), 200u);
  for (std::size_t n = 0; n < taken.size(); ++n) {
    EXPECT_EQ(taken[n].state.X_DH.translation_mm.x, static_cast<double>(n + 1));  // also what can not be believed
    if (n > 0) {
      EXPECT_GT(taken[n].t_s, taken[n - 1].t_s);
    }
  }
  EXPECT_EQ(hand.dropped(), 0u);
  EXPECT_EQ(device.pushes.load(), 0);
}

}  // namespace
}  // namespace haptics
