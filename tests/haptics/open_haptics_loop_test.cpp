// The OpenHaptics backend under the loop that serves it: emergency stop, supervisor, the gentle end.
#include "haptics/loop/device_loop.h"
#include "tests/haptics/open_haptics_bench.h"

namespace haptics {
namespace {

using namespace open_haptics_bench;

/// Pushes for ever.
class PushingLoop final : public DeviceLoop {
 public:
  explicit PushingLoop(HapticDevice& device) : DeviceLoop(device, 1000.0, std::nullopt) {}
  ~PushingLoop() override { stop(); }

 private:
  Answer answer(const HandleState&, const TickTiming&) noexcept override { return {{{{0.0, 1.0, 0.0}}, {}}, true}; }
};

class OpenHapticsLoop : public OpenHapticsBench {
 protected:
  void untilItPushes() {
    until([&] { return forceNow_N() > 0.99; });
  }
  static void runFor(const DeviceLoop& loop, std::uint64_t ticks) {
    const std::uint64_t then = loop.ticks() + ticks;
    until([&] { return loop.ticks() >= then; });
  }
};

TEST_F(OpenHapticsLoop, GivesNothingAfterAnEmergencyStop) {
  OpenHaptics device(library);
  PushingLoop loop(device);
  loop.start();
  untilItPushes();
  loop.emergencyStop();
  until([&] { return !door.seen.motors_on; });
  runFor(loop, 50);
  EXPECT_EQ(forceNow_N(), 0.0);
  loop.stop();
  EXPECT_EQ(std::ranges::count(door.seen.events, "enable 0x4000"), 1);
  EXPECT_EQ(std::ranges::count(door.seen.events, "force begins"), 1);
}

TEST_F(OpenHapticsLoop, DetectsAHangingSchedulerAndStaysOffWhenItReturns) {
  OpenHaptics device(library);
  PushingLoop loop(device);
  loop.start();
  untilItPushes();
  door.script.hangs = true;
  until([&] { return loop.figures().watchdog_trips >= 1; });
  door.script.hangs = false;
  runFor(loop, 50);
  loop.stop();
  // The supervisor's request is served first, then the loop's command again.
  EXPECT_GE(std::ranges::count(door.seen.events, "enable 0x4000"), 2);
  EXPECT_EQ(door.seen.events.back(), "disable device");
}

TEST_F(OpenHapticsLoop, EndsInMotorsOffThoughTheSchedulerHangs) {
  OpenHaptics device(library);
  PushingLoop loop(device);
  loop.start();
  untilItPushes();
  door.script.hangs = true;
  until([&] { return door.seen.hanging.load(); });
  loop.stop();
  EXPECT_FALSE(door.seen.motors_on);
  EXPECT_EQ(door.seen.events.back(), "disable device");
}

}  // namespace
}  // namespace haptics
