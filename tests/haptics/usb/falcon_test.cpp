#include "haptics/device/usb/falcon.h"
#include "haptics/device/usb/falcon_kinematics.h"
#include "haptics/device/usb/known_devices.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "haptics/latest.h"
#include "haptics/safety/motor_gate.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/usb/falcon_inverse.h"
#include "tests/haptics/usb/held_clock.h"
#include "tests/haptics/usb/simulated_falcon.h"
#include "tests/refusal.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;
using simulated_usb::Bus;
using simulated_usb::Bytes;
using simulated_usb::HeldClock;
using simulated_usb::SimulatedFalcon;

const std::string kNoForce = "<AAAAAAAAAAAA";

/// However busy the machine is.
template <class Condition>
bool soon(const Condition& holds) {
  for (int i = 0; i < 20'000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// Requests one force; keeps the last state it was passed.
class SteadyHand final : public DeviceServo {
 public:
  explicit SteadyHand(const DeviceCapabilities& can) : gate_(can) {}

  MotorCommand tick(const HandleState& state, const TickTiming&) noexcept override {
    states_.publish(state);
    allocations.store(allocation_count::onThisThread());
    ticks.fetch_add(1);
    const std::array<std::atomic<double>, 3>& f = force_N;
    return gate_.admit({{{f[0].load(), f[1].load(), f[2].load()}}, {}}, state.jacobian_D_mm, motors_on.load());
  }
  /// Of the test's thread.
  HandleState last() { return states_.read(); }
  void push(const glm::dvec3& F_N) {
    for (glm::length_t i = 0; i < 3; ++i) force_N[static_cast<std::size_t>(i)].store(F_N[i]);
  }

  std::array<std::atomic<double>, 3> force_N{};
  std::atomic<bool> motors_on{true};
  std::atomic<int> ticks{0};
  std::atomic<std::size_t> allocations{0};  ///< of the device's thread, up to the last tick

 private:
  MotorGate gate_;
  Latest<HandleState> states_;
};

class FalconOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    if (!Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
    bus.emplace();
    bus->plug(SimulatedFalcon::description(), unit);
  }
  /// A program of the simulated unit's size.
  std::filesystem::path programFile() {
    std::mt19937 random(1);
    program.resize(unit.program_bytes);
    for (auto& byte : program) byte = static_cast<std::uint8_t>(random());
    return file(program);
  }
  std::filesystem::path file(const Bytes& bytes) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const auto path = std::filesystem::temp_directory_path() /
                      (std::string("molar_falcon_") + test->name() + "_" + std::to_string(++files_) + ".bin");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  template <class Look>
  auto now(const Look& look) {
    decltype(look()) value{};
    bus->locked([&] { value = look(); });
    return value;
  }
  std::string refusal(const FalconSettings& settings) {
    return tests::refusalOf<DeviceError>([&] { Falcon falcon(settings); });
  }
  void has(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << text; }

  SimulatedFalcon unit;
  Bytes program;
  HeldClock time;
  std::optional<Bus> bus;
  int files_ = 0;
};

TEST_F(FalconOnTheBus, LoadsItsProgramIntoAUnitThatLostIt) {
  FalconSettings settings;
  settings.program = programFile();
  int prompts = 0;
  settings.prompt = [&](const std::string& words) {
    prompts += words.find("loading the Falcon's program") != std::string::npos ? 1 : 0;
    return true;
  };
  const Falcon falcon(settings);
  EXPECT_EQ(now([&] { return unit.program; }), program);
  EXPECT_TRUE(now([&] { return unit.runs; }));
  EXPECT_GT(prompts, 30);  // one for each piece of 62 bytes
  EXPECT_EQ(falcon.capabilities().serial, "FH000001");
}

TEST_F(FalconOnTheBus, AUnitThatStillRunsNeedsNoFile) {
  unit.runs = true;
  const Falcon falcon({});
  EXPECT_EQ(now([&] { return unit.loads_begun; }), 0);
}

TEST_F(FalconOnTheBus, ReportsWhatIsWrongWithItsProgramFile) {
  FalconSettings settings;
  has(refusal(settings), "no file is named");
  settings.program = "/nowhere/falcon.bin";
  has(refusal(settings), "no such file");
  settings.program = std::filesystem::temp_directory_path();
  has(refusal(settings), "not a file");
  settings.program = file({});
  has(refusal(settings), "empty");
  settings.program = file(Bytes(2049));
  has(refusal(settings), "2049 bytes");
  settings.program = file(Bytes(70'000));
  has(refusal(settings), "70000 bytes");
  settings.program = file(Bytes(100));
  has(refusal(settings), "100 bytes");
  EXPECT_EQ(now([&] { return unit.packets.size(); }), 0u);
}

TEST_F(FalconOnTheBus, LoadsAgainAfterAWrongEcho) {
  unit.echo_mistakes = 2;
  FalconSettings settings;
  settings.program = programFile();
  const Falcon falcon(settings);
  EXPECT_EQ(now([&] { return unit.loads_begun; }), 3);
  EXPECT_EQ(now([&] { return unit.program; }), program);
}

TEST_F(FalconOnTheBus, GivesUpAfterRepeatedWrongEchoes) {
  unit.echo_mistakes = 99;
  FalconSettings settings;
  settings.program = programFile();
  has(refusal(settings), "byte 700 of 2048 came back as");
  EXPECT_EQ(now([&] { return unit.loads_begun; }), 3);
}

TEST_F(FalconOnTheBus, GivesUpAUnitThatIsSilent) {
  unit.answers_greeting = false;
  FalconSettings settings;
  settings.program = programFile();
  settings.greetings = 3;
  has(refusal(settings), "does not answer the greeting");
}

TEST_F(FalconOnTheBus, ReportsWhenItIsNotOnTheBus) {
  bus->unplug();
  has(refusal({}), "not on the bus");
}

TEST_F(FalconOnTheBus, PromptsUntilItIsHomed) {
  unit.runs = true;
  unit.homed = 1;
  FalconSettings settings;
  int received = 0;
  settings.prompt = [&](const std::string& words) {
    has(words, "pull the Falcon's grip all the way out");
    if (++received == 5) bus->locked([&] { unit.homed = 7; });
    return true;
  };
  const Falcon falcon(settings);
  EXPECT_GE(received, 5);
  // Red while it waits, and the bit that starts homing.
  EXPECT_EQ(now([&] { return unit.flags; }), 9u);
}

TEST_F(FalconOnTheBus, GivesUpHomingAfterItsTimeoutOrWhenCancelled) {
  unit.runs = true;
  unit.homed = 3;
  FalconSettings settings;
  settings.clock = time.clock();
  int received = 0;
  settings.prompt = [&](const std::string&) {
    ++received;
    time.pass(30s);
    return true;
  };
  has(refusal(settings), "not homed, start again and pull");
  EXPECT_EQ(received, 2);
  settings.prompt = [](const std::string&) { return false; };
  has(refusal(settings), "given up");
}

TEST_F(FalconOnTheBus, ReportsItsPositionAndItsButtons) {
  unit.runs = true;
  unit.buttons = 5;
  unit.grip_mm = {12.0, -20.0, 120.0};
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return hand.ticks.load() > 0 && hand.last().calibrated; }));
  const HandleState state = hand.last();
  EXPECT_LT(glm::length(state.X_DH.translation_mm - glm::dvec3(12.0, -20.0, 120.0)), 0.1);  // three counts
  EXPECT_EQ(state.buttons, 5u);
  EXPECT_FALSE(falcon.capabilities().has_orientation);
  falcon.stop();
}

TEST_F(FalconOnTheBus, PushesTheHandWhereTheForcePoints) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  falcon.start(hand, 1000.0);
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0),
                                glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
    const glm::dvec3 from = now([&] { return unit.grip_mm; });
    hand.push(0.4 * way);
    ASSERT_TRUE(soon([&] { return glm::dot(now([&] { return unit.grip_mm; }) - from, way) > 1.0; }));
    hand.push({});
    ASSERT_TRUE(soon([&] { return now([&] { return unit.words == std::array<int, 3>{}; }); }));
    const glm::dvec3 gone = now([&] { return unit.grip_mm; }) - from;
    EXPECT_GT(glm::dot(gone, way) / glm::length(gone), 0.99);
  }
  falcon.stop();
}

TEST_F(FalconOnTheBus, ASpringToAPointConvergesInAClosedLoop) {
  // A spring of 0.3 N/mm to a point 10 mm away brings the grip there, in the real loop over the bus.
  class Spring final : public DeviceServo {
   public:
    explicit Spring(const DeviceCapabilities& can) : gate_(can) {}
    MotorCommand tick(const HandleState& state, const TickTiming&) noexcept override {
      const glm::dvec3 away = state.X_DH.translation_mm - glm::dvec3(10.0, 5.0, 130.0);
      off_mm.store(glm::length(away));
      return gate_.admit({{-0.3 * away}, {}}, state.jacobian_D_mm, true);
    }
    std::atomic<double> off_mm{1e9};

   private:
    MotorGate gate_;
  };
  unit.runs = true;
  Falcon falcon({});
  Spring spring(falcon.capabilities());
  falcon.start(spring, 1000.0);
  EXPECT_TRUE(soon([&] { return spring.off_mm.load() < 0.3; }));
  EXPECT_LT(glm::length(now([&] { return unit.grip_mm; }) - glm::dvec3(10.0, 5.0, 130.0)), 1.0);
  falcon.stop();
}

TEST_F(FalconOnTheBus, ItsThreadAllocatesNothing) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.2, 0.3});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  const std::size_t before = hand.allocations.load();
  bus->locked([&] { unit.garbage = true; });
  ASSERT_TRUE(soon([&] { return !hand.last().healthy; }));
  bus->locked([&] { unit.garbage = false; });
  ASSERT_TRUE(soon([&] { return hand.last().healthy; }));
  bus->unplug();
  const int ticks = hand.ticks.load();
  ASSERT_TRUE(soon([&] { return hand.ticks.load() > ticks + 50; }));
  EXPECT_EQ(hand.allocations.load(), before);
  falcon.stop();
}

TEST_F(FalconOnTheBus, AnUnmeasuredUnitGetsATenthOfItsMotorRangeAtMost) {
  unit.runs = true;
  Falcon falcon({});
  EXPECT_FALSE(falcon.capabilities().force_is_calibrated);
  EXPECT_EQ(falcon.capabilities().peak_force_N, 1.0);
  // A gate that lets everything through, so that the device stands alone.
  DeviceCapabilities no_limits;
  no_limits.peak_force_N = 100.0;
  SteadyHand hand(no_limits);
  hand.push({50.0, -30.0, 20.0});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.largest_word; }) > 300; }));
  const std::size_t before = now([&] { return unit.packets.size(); });
  ASSERT_TRUE(soon([&] { return now([&] { return unit.packets.size(); }) > before + 30; }));
  falcon.stop();
  EXPECT_LE(now([&] { return unit.largest_word; }), 409);
}

TEST_F(FalconOnTheBus, AMeasuredScaleChangesTheWordsAndCountsAsCalibrated) {
  unit.runs = true;
  FalconSettings settings;
  settings.scale = {20.0, 1.5, "FH000001"};
  Falcon falcon(settings);
  EXPECT_TRUE(falcon.capabilities().force_is_calibrated);
  EXPECT_EQ(falcon.capabilities().peak_force_N, 4.5);
  const calibration::Point<calibration::Device> middle = falconMiddle();
  const glm::dvec3 expected =
      -20.0 * glm::transpose(falconJacobian_mm(*falconLegsAt_rad(middle), middle)) * glm::dvec3(0.0, 0.0, 0.5);
  bus->locked([&] { unit.true_words_per_Nmm = 1e9; });  // does not move away
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.0, 0.5});
  falcon.start(hand, 1000.0);
  EXPECT_TRUE(soon([&] { return std::abs(now([&] { return unit.words; })[0] - expected.x) < 2.0; }));
  falcon.stop();
}

TEST_F(FalconOnTheBus, RefusesAnImplausibleScale) {
  unit.runs = true;
  FalconSettings settings;
  settings.scale = {500.0, 1.0, ""};
  has(refusal(settings), "words per N mm");
}

TEST_F(FalconOnTheBus, RefusesTheScaleOfAnotherUnit) {
  unit.runs = true;
  FalconSettings settings;
  settings.scale = {10.0, 1.0, "FH000002"};
  has(refusal(settings), "weighed on unit FH000002 and this is FH000001");
}

TEST_F(FalconOnTheBus, GarbageGivesNeitherAPositionNorAForce) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.0, 0.3});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  bus->locked([&] { unit.garbage = true; });
  ASSERT_TRUE(soon([&] { return !hand.last().healthy; }));
  EXPECT_TRUE(soon([&] { return now([&] { return unit.words == std::array<int, 3>{}; }); }));
  // And back.
  bus->locked([&] { unit.garbage = false; });
  EXPECT_TRUE(soon([&] { return hand.last().healthy && now([&] { return unit.words[0] != 0; }); }));
  falcon.stop();
}

TEST_F(FalconOnTheBus, AsksASilentUnitSeldomAndWithoutForce) {
  unit.runs = true;
  // Time stands on the line: what goes out is the servo's, no rest comes by itself after a silence.
  FalconSettings settings;
  settings.clock = time.clock();
  Falcon falcon(settings);
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.0, 0.3});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  bus->locked([&] { unit.answers_packets = false; });
  ASSERT_TRUE(soon([&] { return !hand.last().healthy && now([&] { return unit.words[0] == 0; }); }));
  const int ticks = hand.ticks.load();
  const std::size_t before = now([&] { return unit.packets.size(); });
  ASSERT_TRUE(soon([&] { return hand.ticks.load() > ticks + 200; }));
  const std::size_t after = now([&] { return unit.packets.size(); });
  EXPECT_LE(after - before, static_cast<std::size_t>(hand.ticks.load() - ticks) / 5 + 2);
  falcon.stop();
}

TEST_F(FalconOnTheBus, LosingItsHomeStopsTheForce) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.0, 0.3});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  bus->locked([&] { unit.homed = 5; });
  const std::size_t before = now([&] { return unit.packets.size(); });
  ASSERT_TRUE(soon([&] { return now([&] { return unit.packets.size(); }) > before + 30; }));
  EXPECT_FALSE(hand.last().calibrated);
  // Whoever shows red does not push.
  const auto packets = now([&] { return unit.packets; });
  EXPECT_NE((packets.back()[13] - 'A') & 8, 0);
  for (const std::string& packet : packets)
    EXPECT_TRUE(((packet[13] - 'A') & 8) == 0 || packet.starts_with(kNoForce)) << packet;
  falcon.stop();
}

TEST_F(FalconOnTheBus, UnpluggedWhilePushingItIsUnhealthyAndStopsCleanly) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  hand.push({0.2, 0.0, 0.2});
  falcon.start(hand, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  bus->unplug();
  EXPECT_TRUE(soon([&] { return !hand.last().healthy; }));
  const int ticks = hand.ticks.load();
  EXPECT_TRUE(soon([&] { return hand.ticks.load() > ticks + 20; }));
  falcon.stop();
  falcon.stop();
}

TEST_F(FalconOnTheBus, AGoneUnitDoesNotStart) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  bus->unplug();
  ASSERT_TRUE(soon([&] {
    try {
      falcon.start(hand, 400.0);  // no rate it serves: gone is said first
    } catch (const DeviceError& error) {
      return std::string(error.what()).find("unplugged") != std::string::npos;
    }
    return false;
  }));
  EXPECT_EQ(hand.ticks.load(), 0);
}

TEST_F(FalconOnTheBus, TheLastPacketHasNoForceAndNothingFollowsIt) {
  unit.runs = true;
  {
    Falcon falcon({});
    SteadyHand hand(falcon.capabilities());
    hand.push({0.0, 0.0, 0.3});
    falcon.start(hand, 1000.0);
    ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
    falcon.stop();
    const auto packets = now([&] { return unit.packets; });
    // No force, homing counts on, lights out.
    EXPECT_EQ(packets.back(), kNoForce + "BA>");
    falcon.motorsOff();  // whoever would send is joined
    EXPECT_EQ(now([&] { return unit.packets.size(); }), packets.size());
  }
  EXPECT_EQ(now([&] { return unit.packets.back(); }), kNoForce + "BA>");
  EXPECT_EQ(now([&] { return unit.refused; }), 0);
}

TEST_F(FalconOnTheBus, MotorsOffActsAtOnceAndALaterCommandIsExecuted) {
  unit.runs = true;
  Falcon falcon({});
  SteadyHand hand(falcon.capabilities());
  hand.push({0.0, 0.0, 0.3});
  falcon.start(hand, 1000.0);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
    const std::size_t before = now([&] { return unit.packets.size(); });
    falcon.motorsOff();
    ASSERT_TRUE(soon([&] {
      return now([&] {
        return std::any_of(unit.packets.begin() + static_cast<std::ptrdiff_t>(before), unit.packets.end(),
                           [](const std::string& packet) { return packet.starts_with(kNoForce); });
      });
    }));
  }
  falcon.stop();
}

/// Pushes, and hangs in the middle of a tick while requested.
class HangingServo final : public DeviceServo {
 public:
  explicit HangingServo(const DeviceCapabilities& can) : gate_(can) {}
  MotorCommand tick(const HandleState& state, const TickTiming&) noexcept override {
    while (hangs.load()) std::this_thread::sleep_for(1ms);
    return gate_.admit({{{0.0, 0.0, 0.3}}, {}}, state.jacobian_D_mm, true);
  }
  std::atomic<bool> hangs{false};

 private:
  MotorGate gate_;
};

TEST_F(FalconOnTheBus, MotorsOffWhileTheServoHangsHoldsUntilItTicksAgain) {
  unit.runs = true;
  Falcon falcon({});
  HangingServo servo(falcon.capabilities());
  falcon.start(servo, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  servo.hangs.store(true);
  falcon.motorsOff();
  EXPECT_TRUE(soon([&] { return now([&] { return unit.words == std::array<int, 3>{}; }); }));
  servo.hangs.store(false);
  EXPECT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  falcon.stop();
}

TEST_F(FalconOnTheBus, TheUsbThreadEndsTheForceOfAHangingServo) {
  unit.runs = true;
  Falcon falcon({});
  HangingServo servo(falcon.capabilities());
  falcon.start(servo, 1000.0);
  ASSERT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  servo.hangs.store(true);
  EXPECT_TRUE(soon([&] { return now([&] { return unit.words == std::array<int, 3>{}; }); }));
  servo.hangs.store(false);
  EXPECT_TRUE(soon([&] { return now([&] { return unit.words[0] != 0; }); }));
  falcon.stop();
}

TEST_F(FalconOnTheBus, IsFoundWithItsPlaceAndTheNextStep) {
  const auto found = findFalcon();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].address, "falcon:1-1");
  EXPECT_EQ(found[0].location, "USB 1-1, 0403:cb48");
  has(found[0].advice, "firmware");
}

}  // namespace
}  // namespace haptics
