// Trouble and ends of the OpenHaptics backend: errors, unplugging, slow and hanging schedulers, refusals, two runs.
#include "tests/haptics/open_haptics_bench.h"
#include "tests/refusal.h"

namespace haptics {
namespace {

using namespace open_haptics_bench;
using testing::HasSubstr;

class OpenHapticsTrouble : public OpenHapticsBench {
 protected:
  /// After a fatal error the amplifiers go off at once: a tick has one frame, and that one has pushed.
  void expectTheAbruptEnd() { EXPECT_EQ(std::erase(door.seen.violations, "motors off in the middle of a force"), 1u); }
};

std::string refusal(const std::function<void()>& attempt) {
  return tests::refusalOf<DeviceError>([&] { attempt(); });
}

TEST_F(OpenHapticsTrouble, ReportsWhyADeviceDoesNotStart) {
  for (const HdErrorMeaning& meaning : hdErrorMeanings()) {
    door.script.init_error = meaning.code;
    const std::string words = refusal([&] { OpenHaptics device(library, {.configuration = "Left"}); });
    EXPECT_THAT(words, HasSubstr("OpenHaptics, device \"Left\", HD 0x"));
    EXPECT_THAT(words, HasSubstr(meaning.what_to_do));
  }
}

TEST_F(OpenHapticsTrouble, ContinuesAfterPassingErrorsAndEndsTheForceAfterFatalOnes) {
  for (const HdErrorMeaning& meaning : hdErrorMeanings()) {
    door.reset();
    Pusher servo({0.0, 1.0, 0.0});
    OpenHaptics device(library);
    device.start(servo, 1000.0);
    until([&] { return forceNow_N() == 1.0; });
    door.script.error_code = meaning.code;
    until([&] { return device.errors().count(meaning.code) == 1; });
    runFor(servo, 5);
    const bool is_fatal = meaning.kind == HdErrorKind::fatal;
    EXPECT_EQ(servo.state().healthy, !is_fatal) << meaning.code;
    EXPECT_EQ(door.seen.motors_on, !is_fatal) << meaning.code;
    EXPECT_EQ(forceNow_N(), is_fatal ? 0.0 : 1.0) << meaning.code;
    EXPECT_THAT(device.trouble(), is_fatal ? HasSubstr(meaning.what) : HasSubstr(""));
    EXPECT_EQ(device.trouble().empty(), !is_fatal);
    device.stop();
    if (is_fatal) expectTheAbruptEnd();
    EXPECT_THAT(door.seen.violations, testing::IsEmpty());
  }
}

TEST_F(OpenHapticsTrouble, DrainsAFloodOfErrorsInBoundedPortions) {
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  runFor(servo, 5);
  door.script.error_times = 90;
  door.script.error_code = 0x0202;
  until([&] { return device.errors().count(0x0202) == 90; });
  EXPECT_TRUE(servo.state().healthy);
  device.stop();
}

TEST_F(OpenHapticsTrouble, CountsExcessiveForceAndContinues) {
  Pusher servo({0.0, 5.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return device.errors().count(0x0201) > 3; });
  EXPECT_TRUE(servo.state().healthy);
  device.stop();
}

TEST_F(OpenHapticsTrouble, SurvivesBeingUnpluggedWhilePushing) {
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return forceNow_N() == 1.0; });
  door.script.unplugged = true;
  until([&] { return servo.unhealthy > 20; });
  EXPECT_FALSE(door.seen.motors_on);
  EXPECT_EQ(forceNow_N(), 0.0);
  EXPECT_THAT(device.trouble(), HasSubstr("HD 0x0302"));
  device.stop();
  EXPECT_THAT(door.seen.events.back(), "disable device");
  expectTheAbruptEnd();
}

TEST_F(OpenHapticsTrouble, SwitchesItsMotorsOffForAnyThread) {
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  for (int i = 0; i < 5; ++i) {
    until([&] { return forceNow_N() == 1.0; });
    servo.pushes = false;
    device.motorsOff();
    until([&] { return !door.seen.motors_on; });
    servo.pushes = true;
  }
  // A held force is cut to zero for one frame and served again in the next.
  until([&] { return forceNow_N() == 1.0; });
  const long ticks = servo.ticks;
  std::thread([&] { device.motorsOff(); }).join();
  runFor(servo, 5);
  EXPECT_GT(servo.ticks, ticks);
  device.stop();
  EXPECT_GE(std::ranges::count(door.seen.events, "disable 0x4000"), 7);
}

TEST_F(OpenHapticsTrouble, VoidsACommandThatWasMadeBeforeTheMotorsWentOff) {
  Pusher servo({0.0, 1.0, 0.0});
  servo.hold_at_tick = 20;
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return servo.held_up.load(); });
  // In the middle of a tick that hangs; no wait for it.
  device.motorsOff();
  EXPECT_EQ(servo.ticks, 20);
  // By the next tick its frame has gone out: no force.
  servo.hold_at_tick = 21;
  until([&] { return servo.ticks == 21 && servo.held_up; });
  EXPECT_EQ(forceNow_N(), 0.0);
  EXPECT_FALSE(door.seen.motors_on);
  servo.hold_at_tick = -1;
  until([&] { return servo.ticks > 25; });
  device.stop();
  const std::vector<std::string> once{"force begins", "force ends", "disable 0x4000", "enable 0x4000", "force begins"};
  const auto& events = door.seen.events;
  EXPECT_NE(std::search(events.begin(), events.end(), once.begin(), once.end()), events.end());
}

TEST_F(OpenHapticsTrouble, CountsTheTicksThatASlowServoOrSchedulerMissed) {
  Pusher servo({0.0, 1.0, 0.0});
  servo.slow_at_tick = 20;
  servo.slow_ms = 30;
  door.script.slow_at_tick = 60;
  door.script.slow_ms = 40;
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return servo.ticks > 80; });
  EXPECT_GE(servo.missed, 28 + 38);
  EXPECT_GE(servo.late_max_us, 38e3);
  device.stop();
}

TEST_F(OpenHapticsTrouble, StopsCleanlyWhileTheSchedulerHangs) {
  Pusher servo({0.0, 1.0, 0.0});
  OpenHaptics device(library);
  device.start(servo, 1000.0);
  until([&] { return forceNow_N() == 1.0; });
  door.script.hangs = true;
  until([&] { return door.seen.hanging.load(); });
  // Only the servo thread may call the device: the request is queued, the caller returns at once.
  device.motorsOff();
  EXPECT_TRUE(door.seen.motors_on);
  device.stop();
  EXPECT_EQ(forceNow_N(), 0.0);
  const auto& events = door.seen.events;
  const std::vector<std::string> tail(events.end() - 5, events.end());
  EXPECT_THAT(tail, testing::ElementsAre("stop", "force ends", "disable 0x4000", "unschedule", "disable device"));
}

TEST_F(OpenHapticsTrouble, RefusesUnsupportedRates) {
  Pusher servo;
  for (double rate_Hz : {2000.0, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    OpenHaptics device(library);
    EXPECT_THAT(refusal([&] { device.start(servo, rate_Hz); }), HasSubstr("choose from 500 to 1000 Hz"));
    device.stop();
  }
  door.script.refused_rate_Hz = 700;
  {
    OpenHaptics device(library);
    EXPECT_THAT(refusal([&] { device.start(servo, 700.0); }), HasSubstr("ask for 1000 Hz"));
  }
  door.script.update_rate_Hz = 2000;
  {
    OpenHaptics device(library);
    device.start(servo, 2000.0);
    runFor(servo, 5);
  }
  EXPECT_EQ(std::ranges::count(door.seen.events, "disable device"), 5);
}

TEST_F(OpenHapticsTrouble, IsClosedAfterAStartThatThrew) {
  Pusher servo({0.0, 1.0, 0.0});
  for (unsigned code : {0x0500u, 0x0501u}) {
    door.reset();
    door.script.schedule_error = code;
    OpenHaptics device(library);
    EXPECT_THAT(refusal([&] { device.start(servo, 1000.0); }), HasSubstr("the servo cannot be scheduled"));
    device.stop();
    device.stop();
    EXPECT_EQ(std::ranges::count(door.seen.events, "disable device"), 1);
    EXPECT_FALSE(saw("start") || saw("stop"));
  }
  EXPECT_EQ(servo.ticks, 0);
}

TEST_F(OpenHapticsTrouble, IsClosedThoughItNeverStarted) {
  { OpenHaptics device(library); }
  EXPECT_THAT(door.seen.events, testing::ElementsAre("init default", "disable device"));
}

TEST_F(OpenHapticsTrouble, RunsTwiceInOneProcess) {
  for (int run = 0; run < 2; ++run) {
    Pusher servo({0.0, 1.0, 0.0});
    HdLibrary again;
    OpenHaptics device(again);
    device.start(servo, 1000.0);
    until([&] { return forceNow_N() == 1.0; });
    device.stop();
  }
  EXPECT_EQ(std::ranges::count(door.seen.events, "disable device"), 2);
}

TEST_F(OpenHapticsTrouble, KeepsTheOneSchedulerForOneDevice) {
  ASSERT_TRUE(HdLibrary::claimScheduler());
  Pusher servo;
  OpenHaptics device(library);
  EXPECT_THAT(refusal([&] { device.start(servo, 1000.0); }), HasSubstr("another device of OpenHaptics runs already"));
  device.stop();
  EXPECT_FALSE(HdLibrary::claimScheduler());
  HdLibrary::releaseScheduler();
}

}  // namespace
}  // namespace haptics
