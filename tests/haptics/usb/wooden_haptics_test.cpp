#include "haptics/device/usb/wooden_haptics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <thread>

#include "haptics/device/usb/known_devices.h"
#include "haptics/device/usb/usb_report.h"
#include "haptics/latest.h"
#include "haptics/safety/motor_gate.h"
#include "tests/architecture/forbid_blocking.h"
#include "tests/haptics/usb/held_clock.h"
#include "tests/haptics/usb/simulated_usb.h"
#include "tests/haptics/usb/simulated_wooden.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;
using simulated_usb::Bus;
using simulated_usb::Bytes;
using simulated_usb::HeldClock;
using simulated_usb::SimulatedWooden;

/// However busy the machine is.
template <class Condition>
bool soon(const Condition& holds) {
  for (int i = 0; i < 10'000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// A servo with a law of its own, which can hang. The device stops before it goes.
class Pusher final : public DeviceServo {
 public:
  using Law = std::function<glm::dvec3(const HandleState&)>;
  Pusher(HapticDevice& device, Law law) : device_(device), gate_(device.capabilities()), law_(std::move(law)) {}
  ~Pusher() override {
    hang.store(false);
    device_.stop();
  }

  MotorCommand tick(const HandleState& state, const TickTiming&) noexcept override {
    for (hangs.store(false); hang.load(); std::this_thread::sleep_for(1ms)) hangs.store(true);
    seen.publish(state);
    ticks.fetch_add(1);
    return gate_.admit({{law_(state)}, {}}, state.jacobian_D_mm, true);
  }
  std::atomic<bool> hang{false}, hangs{false};
  std::atomic<int> ticks{0};
  Latest<HandleState> seen;

 private:
  HapticDevice& device_;
  MotorGate gate_;
  Law law_;
};

Pusher::Law always(const glm::dvec3& force_N) {
  return [force_N](const HandleState&) { return force_N; };
}

class WoodenOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    if (!Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
    bus.emplace();
    bus->plug(SimulatedWooden::description(), unit);
  }
  template <class Look>
  auto now(const Look& look) {
    decltype(look()) value{};
    bus->locked([&] { value = look(); });
    return value;
  }
  /// The owner follows every instruction.
  WoodenSettings obedient() {
    WoodenSettings settings;
    settings.prompt = [this](const std::string& words) {
      EXPECT_EQ(words, kWoodenHomingPrompt);
      bus->locked([&] {
        unit.holdAtHome();
        unit.pressSwitch();
      });
      return true;
    };
    return settings;
  }
  WoodenSettings unattended() {
    WoodenSettings settings;
    settings.homing_patience = 0s;
    return settings;
  }
  bool pushes() {
    return now([&] { return unit.mA != std::array<std::int16_t, 3>{}; });
  }
  /// By this side, not by its own watchdog.
  bool toldToRest() {
    return now([&] { return unit.received.back() == std::array<std::int16_t, 7>{}; });
  }
  /// In the middle of its workspace.
  void holdInTheMiddle() {
    bus->locked([&] { unit.hold({0.1, 0.35, 0.65}); });
  }

  SimulatedWooden unit, another;
  HeldClock time;
  std::optional<Bus> bus;
};

std::string reasonOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "";
}

TEST_F(WoodenOnTheBus, IsFoundWithItsPlace) {
  const auto found = findWoodenHaptics();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].address, "wooden:1-1");
  EXPECT_EQ(found[0].location, "USB 1-1, 1234:0006");
  EXPECT_EQ(found[0].advice, "");
  bus->unplug();
  EXPECT_TRUE(soon([] { return findWoodenHaptics().empty(); }));
}

TEST(WoodenAddress, NamesAPlaceAndABuild) {
  EXPECT_EQ(woodenAddressed("wooden")->path, "");
  EXPECT_EQ(woodenAddressed("wooden:1-2.3")->path, "1-2.3");
  EXPECT_EQ(woodenAddressed("wooden:1-2")->model.name, "WoodenHaptics v2019");
  EXPECT_EQ(woodenAddressed("wooden:1-2,v2015")->model.name, "WoodenHaptics v2015");
  EXPECT_EQ(woodenAddressed("wooden:1-2,v2015")->path, "1-2");
  EXPECT_EQ(woodenAddressed("wooden:v2015")->model.name, "WoodenHaptics v2015");
  EXPECT_EQ(woodenAddressed("wooden:v2015")->path, "");
  for (const char* wrong : {"wooden:1-2,v3", "wooden:v3", "falcon:1-2", "woodenv2015", ""})
    EXPECT_FALSE(woodenAddressed(wrong)) << wrong;
}

TEST_F(WoodenOnTheBus, IsWokenHomedAndThenReportsItsPosition) {
  WoodenHaptics wooden(obedient());
  EXPECT_GE(now([&] { return unit.presets; }), 1);
  EXPECT_EQ(wooden.capabilities().serial, "0123456789");
  Pusher idle(wooden, always(glm::dvec3(0.0)));
  wooden.start(idle, 1000.0);
  for (const glm::dvec3& joints :
       {glm::dvec3(0.0, 0.35, 0.65), glm::dvec3(0.4, 0.2, 0.9), glm::dvec3(-0.3, 0.6, 0.5)}) {
    bus->locked([&] { unit.hold(joints); });
    const glm::dvec3 there_mm = now([&] { return unit.position_mm(); });
    EXPECT_TRUE(soon([&] {
      const HandleState& state = idle.seen.read();
      // A count of each encoder is at most 0.08 mm.
      return state.calibrated && state.healthy && glm::distance(state.X_DH.translation_mm, there_mm) < 0.1 &&
             glm::length(state.velocity_D_mm_per_s.xyz) < 1.0;
    }));
  }
  bus->locked([&] { unit.button = true; });
  EXPECT_TRUE(soon([&] { return idle.seen.read().buttons == 1; }));
}

TEST_F(WoodenOnTheBus, ReportsItsVelocity) {
  WoodenHaptics wooden(obedient());
  Pusher idle(wooden, always(glm::dvec3(0.0)));
  wooden.start(idle, 1000.0);
  bus->locked([&] {
    unit.hold({-1.5, 0.35, 0.65});
    unit.swing(0.3);
  });
  // Speed is the reach, some 219 mm, times the rate, square to the way out.
  const double reach_mm = 205.0 * std::sin(0.35) + 245.0 * std::sin(0.65);
  int right = 0;
  EXPECT_TRUE(soon([&] {
    const HandleState& state = idle.seen.read();
    const glm::dvec3 out_mm = state.X_DH.translation_mm + glm::dvec3(220.0, 0.0, 0.0);
    const glm::dvec3 way = glm::normalize(glm::dvec3(-out_mm.y, out_mm.x, 0.0));
    right += glm::distance(state.velocity_D_mm_per_s.xyz, 0.3 * reach_mm * way) < 0.2 * 0.3 * reach_mm ? 1 : 0;
    return right > 50;
  }));
}

TEST_F(WoodenOnTheBus, PushesInTheCommandedDirection) {
  WoodenHaptics wooden(obedient());
  Latest<glm::dvec3> requested_N(glm::dvec3(0.0));
  Pusher pusher(wooden, [&](const HandleState&) { return requested_N.read(); });
  wooden.start(pusher, 1000.0);
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      glm::dvec3 force_N(0.0);
      force_N[axis] = sign;
      requested_N.publish(glm::dvec3(0.0));
      ASSERT_TRUE(soon([&] { return !pushes(); }));
      holdInTheMiddle();
      const glm::dvec3 from_mm = now([&] { return unit.position_mm(); });
      ASSERT_TRUE(soon([&] { return glm::distance(pusher.seen.read().X_DH.translation_mm, from_mm) < 0.1; }));
      requested_N.publish(force_N);
      bus->locked([&] { unit.letGo(); });
      // By the straight way: an arm pushed wrongly may fold until it arrives after all.
      double farthest_back_mm = 0.0;
      EXPECT_TRUE(soon([&] {
        const double moved_mm = glm::dot(now([&] { return unit.position_mm(); }) - from_mm, force_N);
        farthest_back_mm = std::min(farthest_back_mm, moved_mm);
        return moved_mm > 5.0;
      }));
      EXPECT_GT(farthest_back_mm, -0.1);
    }
}

TEST_F(WoodenOnTheBus, ASpringBringsTheHandleToItsEnd) {
  WoodenHaptics wooden(obedient());
  holdInTheMiddle();
  const glm::dvec3 target_mm = now([&] { return unit.position_mm(); }) + glm::dvec3(15.0, -20.0, 25.0);
  Pusher spring(wooden, [&](const HandleState& state) { return 0.05 * (target_mm - state.X_DH.translation_mm); });
  wooden.start(spring, 1000.0);
  bus->locked([&] { unit.letGo(); });
  EXPECT_TRUE(soon([&] { return glm::distance(now([&] { return unit.position_mm(); }), target_mm) < 0.5; }));
}

TEST_F(WoodenOnTheBus, ATickAllocatesNothing) {
  if (tests::ForbidBlocking::countsNothing()) GTEST_SKIP() << "the sanitizer owns malloc";
  WoodenHaptics wooden(obedient());
  holdInTheMiddle();
  // Counted on the device's thread, from one tick to a later one.
  std::optional<tests::ForbidBlocking> guard;
  std::atomic<int> ticks{0};
  std::uint64_t allocations = 1;
  Pusher pusher(wooden, [&](const HandleState&) {
    const int tick = ++ticks;
    if (tick == 10) guard.emplace();
    if (tick == 200) allocations = guard->allocations();
    if (tick == 200) guard.reset();
    return glm::dvec3(0.0, 0.0, 0.5);
  });
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return ticks.load() > 200; }));
  wooden.stop();
  EXPECT_EQ(allocations, 0u);
}

TEST_F(WoodenOnTheBus, NoCurrentExceedsTheClamp) {
  WoodenSettings settings = obedient();
  settings.model = woodenHaptics2015();
  WoodenHaptics wooden(settings);
  holdInTheMiddle();
  Pusher pusher(wooden, always({1e6, -1e6, 1e6}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.largest_mA; }) > 500; }));
  const std::size_t before = now([&] { return unit.received.size(); });
  ASSERT_TRUE(soon([&] { return now([&] { return unit.received.size(); }) > before + 30; }));
  EXPECT_LE(now([&] { return unit.largest_mA; }), 2000);
}

TEST_F(WoodenOnTheBus, HasNoForceBeforeItIsHomed) {
  WoodenHaptics wooden(unattended());
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.5, 0.5, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pusher.ticks.load() > 50; }));
  EXPECT_FALSE(pusher.seen.read().calibrated);
  EXPECT_EQ(now([&] { return unit.largest_mA; }), 0);
  bus->locked([&] { unit.holdAtHome(); });
  wooden.setHome();
  EXPECT_TRUE(soon([&] { return pusher.seen.read().calibrated && pushes(); }));
  EXPECT_NEAR(pusher.seen.read().X_DH.translation_mm.z, 205.0, 0.1);
}

TEST_F(WoodenOnTheBus, ASwitchPressedBeforeTheStartIsIgnored) {
  bus->locked([&] { unit.pressSwitch(); });
  WoodenHaptics wooden(unattended());
  Pusher pusher(wooden, always({0.5, 0.5, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.presets; }) > 0; }));
  const int then = pusher.ticks.load();
  ASSERT_TRUE(soon([&] { return pusher.ticks.load() > then + 50; }));
  EXPECT_FALSE(pusher.seen.read().calibrated);
  EXPECT_EQ(now([&] { return unit.largest_mA; }), 0);
}

TEST_F(WoodenOnTheBus, ReportsWhyItCannotStart) {
  WoodenSettings impatient;
  impatient.prompt = [](const std::string&) { return false; };
  EXPECT_THAT(reasonOf([&] { WoodenHaptics wooden(impatient); }), testing::HasSubstr("not homed, given up"));
  impatient.clock = time.clock();
  int received = 0;
  impatient.prompt = [&](const std::string&) {
    ++received;
    time.pass(30s);
    return true;
  };
  EXPECT_THAT(reasonOf([&] { WoodenHaptics wooden(impatient); }), testing::HasSubstr(kWoodenHomingPrompt));
  EXPECT_EQ(received, 2);
  EXPECT_EQ(now([&] { return unit.largest_mA; }), 0);
}

TEST_F(WoodenOnTheBus, ReportsThatItDoesNotAnswer) {
  bus->set({.in_silent = true});
  EXPECT_THAT(reasonOf([&] { WoodenHaptics wooden(unattended()); }), testing::HasSubstr("it does not answer"));
}

TEST_F(WoodenOnTheBus, MotorsOffWorksWhileTheServoHangs) {
  // Time stands: no rest comes by itself after a silence.
  WoodenSettings settings = obedient();
  settings.clock = time.clock();
  WoodenHaptics wooden(settings);
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
  wooden.start(pusher, 1000.0);
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(soon([&] { return pushes(); }));
    pusher.hang.store(true);
    ASSERT_TRUE(soon([&] { return pusher.hangs.load(); }));
    wooden.motorsOff();
    ASSERT_TRUE(soon([&] { return toldToRest(); }));
    HeldClock::settle(*bus);
    EXPECT_TRUE(toldToRest());
    pusher.hang.store(false);
  }
  EXPECT_EQ(wooden.counters().silences, 0u);
  EXPECT_TRUE(soon([&] { return pushes(); })) << "a later tick is served";
}

TEST_F(WoodenOnTheBus, AHangingServoIsRestedAutomatically) {
  WoodenSettings settings = obedient();
  settings.clock = time.clock();
  WoodenHaptics wooden(settings);
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pushes(); }));
  pusher.hang.store(true);
  ASSERT_TRUE(soon([&] { return pusher.hangs.load(); }));
  EXPECT_FALSE(toldToRest());
  // The device's own watchdog, after 0.5 s, has no part in it: for the device time stands.
  bus->holdTime();
  const int trips = now([&] { return unit.watchdog_trips; });
  time.pass(20ms);
  EXPECT_TRUE(soon([&] { return toldToRest(); }));
  EXPECT_EQ(now([&] { return unit.watchdog_trips; }), trips);
  EXPECT_EQ(wooden.counters().silences, 1u);
  bus->letTimePass();
  pusher.hang.store(false);
  EXPECT_TRUE(soon([&] { return pushes(); }));
}

TEST_F(WoodenOnTheBus, EndsWithZeroForceAndNothingAfterIt) {
  // Also while the servo hangs: stop() waits for it, the motors do not, nor for the rest that follows a silence.
  WoodenSettings settings = obedient();
  settings.clock = time.clock();
  WoodenHaptics wooden(settings);
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pushes(); }));
  pusher.hang.store(true);
  ASSERT_TRUE(soon([&] { return pusher.hangs.load(); }));
  std::thread stopping([&] { wooden.stop(); });
  EXPECT_TRUE(soon([&] { return toldToRest(); }));
  const std::size_t received = now([&] { return unit.received.size(); });
  pusher.hang.store(false);
  stopping.join();
  wooden.motorsOff();
  wooden.stop();
  EXPECT_EQ(now([&] { return unit.received.size(); }), received);
  EXPECT_EQ(wooden.counters().silences, 0u);
  EXPECT_EQ(now([&] { return unit.received.back(); }), (std::array<std::int16_t, 7>{}));
  // The device's own watchdog switches its amplifiers off.
  bus->locked([&] { unit.onTime(1e6); });
  EXPECT_FALSE(now([&] { return unit.enabled; }));
}

TEST_F(WoodenOnTheBus, SurvivesASilentLineAndTheDevicesWatchdog) {
  WoodenHaptics wooden(obedient());
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pushes(); }));
  const int trips = now([&] { return unit.watchdog_trips; });
  bus->set({.in_silent = true, .out_refused = true});
  ASSERT_TRUE(soon([&] { return !pusher.seen.read().healthy; }));
  EXPECT_FALSE(pusher.seen.read().fresh);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.watchdog_trips > trips && !unit.enabled; }); }));
  EXPECT_FALSE(pushes());
  const int then = pusher.ticks.load();
  EXPECT_TRUE(soon([&] { return pusher.ticks.load() > then + 20; })) << "the ticks go on";
  bus->set({});
  EXPECT_TRUE(soon([&] { return pusher.seen.read().healthy && pushes(); }));
}

TEST_F(WoodenOnTheBus, SurvivesHaltsShortReportsAndGarbage) {
  WoodenHaptics wooden(obedient());
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.2, -0.3, 0.4}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pushes(); }));
  bus->set({.in_halted = true, .out_halted = true});
  ASSERT_TRUE(soon([&] { return wooden.counters().stalls >= 1 && pusher.seen.read().healthy; }));
  std::mt19937 generator(5);
  bus->locked([&] {
    unit.spoil = [&](Bytes& bytes) {
      const auto dice = static_cast<unsigned>(generator());
      if (dice % 4 == 0) bytes.resize(dice >> 8 & 31);
      if (dice % 4 == 1)
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator());
      if (dice % 4 == 2) bytes[dice >> 8 & 15 ? dice % 14 : 0] ^= static_cast<std::uint8_t>(dice >> 16);
    };
  });
  const int then = pusher.ticks.load();
  ASSERT_TRUE(soon([&] { return pusher.ticks.load() > then + 300 && wooden.counters().short_reports > 10; }));
  EXPECT_LE(now([&] { return unit.largest_mA; }), 2000);
  bus->locked([&] { unit.spoil = {}; });
  const glm::dvec3 there_mm = now([&] { return unit.position_mm(); });
  EXPECT_TRUE(soon([&] {
    const HandleState& state = pusher.seen.read();
    return state.healthy && glm::distance(state.X_DH.translation_mm, there_mm) < 0.1;
  }));
}

TEST_F(WoodenOnTheBus, SurvivesBeingUnpluggedWhilePushing) {
  WoodenHaptics wooden(obedient());
  holdInTheMiddle();
  Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
  wooden.start(pusher, 1000.0);
  ASSERT_TRUE(soon([&] { return pushes(); }));
  bus->unplug();
  ASSERT_TRUE(soon([&] { return !pusher.seen.read().healthy; }));
  const int then = pusher.ticks.load();
  EXPECT_TRUE(soon([&] { return pusher.ticks.load() > then + 20; }));
  wooden.motorsOff();
  wooden.stop();
  // Plugged in again it is another one, and begins from the start.
  simulated_usb::Description replugged = SimulatedWooden::description();
  replugged.number = 3;
  bus->plug(replugged, another);
  WoodenHaptics fresh(unattended());
  Pusher idle(fresh, always(glm::dvec3(0.0)));
  fresh.start(idle, 500.0);
  EXPECT_TRUE(soon([&] { return idle.ticks.load() > 5 && idle.seen.read().healthy; }));
  EXPECT_FALSE(idle.seen.read().calibrated);
  fresh.stop();
}

TEST_F(WoodenOnTheBus, IsServedAgainAfterItWasClosed) {
  for (int i = 0; i < 3; ++i) {
    WoodenHaptics wooden(obedient());
    holdInTheMiddle();
    Pusher pusher(wooden, always({0.0, 0.0, 0.5}));
    wooden.start(pusher, 1000.0);
    ASSERT_TRUE(soon([&] { return pushes(); }));
  }
  EXPECT_FALSE(pushes());
}

TEST_F(WoodenOnTheBus, RefusesAnUnsupportedRate) {
  WoodenHaptics wooden(unattended());
  Pusher idle(wooden, always(glm::dvec3(0.0)));
  EXPECT_THROW(wooden.start(idle, 4000.0), DeviceError);
  wooden.stop();
}

}  // namespace
}  // namespace haptics
