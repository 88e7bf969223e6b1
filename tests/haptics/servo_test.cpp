#include "haptics/servo/servo.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "haptics/device/simulated/scripted_device.h"
#include "haptics/servo/tick_log.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/phantom.h"

namespace haptics {
namespace {

using namespace phantom;

HandSample handAt(const glm::dvec3& p, bool pedal = false) {
  HandSample hand;
  hand.X_PT.translation_mm = p;
  hand.drill_pedal = pedal;
  return hand;
}

/// A session of the scripted hand on flat bone; every tick through a log.
std::vector<Tick> session(double seconds) {
  Bodies bone = halfSpace(12.0, 0.25).bodies(1);
  Servo servo(bone);
  assets::StraightCut cut;
  cut.outward_P = {0.0, 0.0, 1.0};
  cut.lateral_P = {0.0, 1.0, 0.0};
  cut.bur_radius_mm = 1.5;
  cut.depth_mm = 2.0;
  ScriptedDevice device(assets::plannedAlong(cut), {.clearance_mm = 2.0});
  Command command;
  command.tool.head.radius_mm = 1.5;
  TickLog log(100'000);
  Vector<Patient> force;
  for (int i = 0; i < static_cast<int>(seconds * 1000.0); ++i) {
    const HandleState state = device.exchange({{force.xyz}, {}}, 1e-3);
    HandSample hand;
    hand.X_PT = {state.X_DH.rotation, state.X_DH.translation_mm};
    hand.velocity_P_mm_per_s.xyz = state.velocity_D_mm_per_s.xyz;
    hand.drill_pedal = state.pedal;
    const Tick tick = servo.step(hand, command, 1e-3);
    force = tick.commanded_force_P_N;
    log.push(tick);
  }
  std::vector<Tick> ticks;
  log.drainInto(ticks);
  return ticks;
}

TEST(Servo, ReplaysBitForBit) {
  const std::vector<Tick> recorded = session(1.5);
  ASSERT_EQ(recorded.size(), 1500u);
  Bodies bone = halfSpace(12.0, 0.25).bodies(1);
  Servo servo(bone);
  Command command;
  command.tool.head.radius_mm = 1.5;
  for (const Tick& tick : recorded) {
    const Tick again = servo.step(tick.hand, command, tick.dt_s);
    ASSERT_EQ(again.index, tick.index);
    ASSERT_EQ(std::memcmp(&again.law_force_P_N, &tick.law_force_P_N, sizeof tick.law_force_P_N), 0);
    ASSERT_EQ(std::memcmp(&again.commanded_force_P_N, &tick.commanded_force_P_N, sizeof tick.commanded_force_P_N), 0);
    ASSERT_EQ(std::memcmp(&again.proxy_P, &tick.proxy_P, sizeof tick.proxy_P), 0);
    ASSERT_EQ(again.bone_digest, tick.bone_digest);
    ASSERT_EQ(again.removed_mm3, tick.removed_mm3);
  }
}

TEST(Servo, HandInstrumentsMeetBoneAndTakeNothingAway) {
  for (std::size_t n = 1; n < kHandInstrumentKeys.size(); ++n) {
    Bodies bone = halfSpace(12.0, 0.25).bodies(1);
    const std::uint64_t digest = bone.digest();
    Servo servo(bone);
    Command command;
    command.tool = handInstrumentTool(static_cast<HandInstrument>(n));
    Tick tick;
    for (int i = 0; i < 400; ++i) {
      const double z_mm = 3.6 - 0.01 * i + command.tool.head.radius_mm;
      tick = servo.step(handAt({0.01 * i - 2.0, 0.0, z_mm}, i > 100), command, 1e-3);
      ASSERT_FALSE(tick.drilling);
      ASSERT_EQ(tick.spindle_rad_per_s, 0.0);
    }
    EXPECT_GT(tick.law_force_P_N.xyz.z, 0.1) << kHandInstrumentKeys[n];
    EXPECT_GT(tick.depth_mm, 0.0) << kHandInstrumentKeys[n];
    // A file that is pressed and drawn takes bone.
    if (command.tool.hand_instrument != HandInstrument::bone_file) {
      EXPECT_EQ(bone.digest(), digest) << kHandInstrumentKeys[n];
    }
  }
}

TEST(Servo, CutsATroughUnderTheScriptedHand) {
  const std::vector<Tick> ticks = session(11.0);
  double removed = 0.0, most_N = 0.0, deepest_mm = 0.0, roughest_N = 0.0;
  glm::dvec3 last_N(0.0);
  for (const Tick& tick : ticks) {
    removed += tick.removed_mm3;
    most_N = std::max(most_N, glm::length(tick.commanded_force_P_N.xyz));
    if (tick.drilling) deepest_mm = std::min(deepest_mm, tick.proxy_P.mm.z - 1.5);
    ASSERT_EQ(tick.faults, Fault::none);
    roughest_N = std::max(roughest_N, glm::length(tick.commanded_force_P_N.xyz - last_N));
    last_N = tick.commanded_force_P_N.xyz;
  }
  // A trough 8 mm long, 3 mm wide and 2 mm deep with a round floor and ends.
  EXPECT_GT(removed, 27.0);
  EXPECT_LT(removed, 50.0);
  EXPECT_NEAR(deepest_mm, -1.8, 0.25);
  EXPECT_GT(most_N, 0.05);
  EXPECT_LT(most_N, 2.0);
  EXPECT_LT(roughest_N, 0.1);
}

TEST(Servo, NeverServesMoreThanItsLimitsOrFasterInARandomWalk) {
  Bodies bone = filled(5.0, 0.25, [](const glm::dvec3& p) {
                  return std::sin(1.3 * p.x) + std::sin(1.7 * p.y) + std::sin(1.1 * p.z) + 0.5;
                }).bodies(1);
  Servo servo(bone);
  Command command;
  command.tool.head.radius_mm = 1.0;
  command.law.damping_Ns_per_mm = 0.001;
  std::mt19937 random(2);
  std::normal_distribution<double> step(0.0, 0.05);
  glm::dvec3 hand(0.0), last(0.0);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 move(step(random), step(random), step(random));
    hand = glm::clamp(hand + move, -6.0, 6.0);
    HandSample sample = handAt(hand, i % 500 > 250);
    sample.velocity_P_mm_per_s.xyz = move * 1000.0;
    if (i % 97 == 0) sample.X_PT.translation_mm.y = std::numeric_limits<double>::quiet_NaN();
    if (i % 211 == 0) sample.X_PT.translation_mm.x += 5000.0;
    if (i % 307 == 0) sample.X_PT.rotation = glm::dquat(0.0, 0.0, 0.0, 0.0);
    const Tick tick = servo.step(sample, command, 1e-3);
    ASSERT_LE(glm::length(tick.commanded_force_P_N.xyz), 3.3 * (1.0 + 1e-12));
    // Down it may go at once where the pose is in doubt.
    ASSERT_LE(glm::length(tick.commanded_force_P_N.xyz) - glm::length(last), 0.3 * (1.0 + 1e-12));
    if (!has(tick.faults, Fault::bad_pose | Fault::overdrawn)) {
      ASSERT_LE(glm::length(tick.commanded_force_P_N.xyz - last), 0.3 * (1.0 + 1e-12)) << i;
    }
    ASSERT_TRUE(std::isfinite(glm::length(tick.law_force_P_N.xyz)));
    last = tick.commanded_force_P_N.xyz;
  }
}

TEST(Servo, HoldsAndLetsGoWhenThePoseIsAbsurd) {
  Bodies bone = halfSpace(4.0, 0.2).bodies();
  Servo servo(bone);
  Tick tick;
  for (int i = 0; i < 50; ++i) tick = servo.step(handAt({0.0, 0.0, 1.0}), {}, 1e-3);
  EXPECT_NEAR(tick.commanded_force_P_N.xyz.z, 0.8, 0.01);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const glm::dvec3& absurd : {glm::dvec3(nan, 0.0, 0.0), glm::dvec3(0.0, 3000.0, 0.0), glm::dvec3(1e200)}) {
    for (int i = 0; i < 20; ++i) {
      tick = servo.step(handAt(absurd, true), {}, 1e-3);
      EXPECT_TRUE(has(tick.faults, Fault::bad_pose));
      EXPECT_FALSE(tick.drilling);
      EXPECT_EQ(tick.removed_mm3, 0.0);
    }
    EXPECT_EQ(glm::length(tick.commanded_force_P_N.xyz), 0.0);
    for (int i = 0; i < 50; ++i) tick = servo.step(handAt({0.0, 0.0, 1.0}), {}, 1e-3);
    EXPECT_EQ(tick.faults, Fault::none);
    EXPECT_NEAR(tick.commanded_force_P_N.xyz.z, 0.8, 0.01);
  }
}

TEST(Servo, AcceptsADeviceThatStaysFarAway) {
  Bodies bone = halfSpace(4.0, 0.2).bodies();
  Servo servo(bone);
  servo.step(handAt({0.0, 0.0, 50.0}), {}, 1e-3);
  Tick tick;
  for (int i = 0; i < 120; ++i) tick = servo.step(handAt({0.0, 0.0, 3000.0}), {}, 1e-3);
  EXPECT_EQ(tick.faults, Fault::none);
  EXPECT_EQ(tick.proxy_P.mm.z, 3000.0);
}

TEST(Servo, LetsGoWhenTheDeviceIsUnwell) {
  Bodies bone = halfSpace(4.0, 0.2).bodies();
  Servo servo(bone);
  HandSample hand = handAt({0.0, 0.0, 1.0});
  for (int i = 0; i < 50; ++i) servo.step(hand, {}, 1e-3);
  hand.device_healthy = false;
  Tick tick;
  for (int i = 0; i < 20; ++i) tick = servo.step(hand, {}, 1e-3);
  EXPECT_TRUE(has(tick.faults, Fault::device));
  EXPECT_EQ(glm::length(tick.commanded_force_P_N.xyz), 0.0);
}

TEST(Servo, ArmsWhereTheHandIsAndNotWhereItOnceCouldNotGo) {
  // Through a plate while docked: there is no force that could have stopped it.
  Bodies bone = filled(4.0, 0.2, [](const glm::dvec3& p) { return std::abs(p.z) - 0.6; }).bodies();
  Servo servo(bone);
  Command command;
  command.tool.head.radius_mm = 0.6;
  command.safety = strict(command.safety);
  HandSample hand = handAt({0.0, 0.0, 2.0});
  hand.docked = true;
  Tick tick;
  for (; hand.X_PT.translation_mm.z > -2.0; hand.X_PT.translation_mm.z -= 0.02) tick = servo.step(hand, command, 1e-3);
  EXPECT_EQ(tick.state, SafetyState::ready);
  hand.docked = false;
  for (int i = 0; i < 5; ++i) tick = servo.step(hand, command, 1e-3);
  EXPECT_EQ(tick.state, SafetyState::active);
  // And from there the plate holds.
  for (int i = 0; i < 800; ++i) tick = servo.step(hand, command, 1e-3);
  for (; hand.X_PT.translation_mm.z < 0.5; hand.X_PT.translation_mm.z += 0.02) tick = servo.step(hand, command, 1e-3);
  EXPECT_LT(tick.commanded_force_P_N.xyz.z, -0.5);
  EXPECT_LT(tick.proxy_P.mm.z, -0.6);
}

TEST(Servo, CutsOnlyWithPedalAndPermission) {
  Bodies bone = halfSpace(4.0, 0.2).bodies();
  Servo servo(bone);
  Command off;
  off.drill_enabled = false;
  EXPECT_EQ(servo.step(handAt({0.0, 0.0, 1.0}, false), {}, 1e-3).removed_mm3, 0.0);
  EXPECT_EQ(servo.step(handAt({0.0, 0.0, 1.0}, true), off, 1e-3).removed_mm3, 0.0);
  double removed = 0.0;
  for (int i = 0; i < 10; ++i) removed += servo.step(handAt({0.0, 0.0, 1.0}, true), {}, 1e-3).removed_mm3;
  EXPECT_GT(removed, 0.0);
}

TEST(Servo, AppliesOnlyValidPartsOfACommand) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Command command;
  command.tool.head.radius_mm = nan;
  command.law.agus.stiffness_N_per_mm = nan;
  command.law.damping_Ns_per_mm = -3.0;
  command.erosion.time.removal_rate_per_s = nan;
  command.safety = {nan, nan};
  const Command safe = sanitised(command);
  EXPECT_EQ(safe.tool.head.radius_mm, Command{}.tool.head.radius_mm);
  EXPECT_EQ(safe.law.damping_Ns_per_mm, 0.0);
  EXPECT_EQ(safe.erosion.time.removal_rate_per_s, Command{}.erosion.time.removal_rate_per_s);
  Bodies bone = halfSpace(4.0, 0.2).bodies();
  Servo servo(bone);
  for (int i = 0; i < 10; ++i) {
    const Tick tick = servo.step(handAt({0.0, 0.0, 0.0}, true), command, nan);
    EXPECT_EQ(glm::length(tick.commanded_force_P_N.xyz), 0.0);
    EXPECT_TRUE(std::isfinite(tick.removed_mm3));
    EXPECT_EQ(tick.dt_s, 1e-3);
  }
}

TEST(Servo, AllocatesNothingInTenThousandTicks) {
  Bodies bone = halfSpace(4.0, 0.25).bodies(1);
  Servo servo(bone);
  TickLog log(10'000);
  Command command;
  command.tool.head.radius_mm = 1.0;
  const std::size_t before = allocation_count::now();
  for (int i = 0; i < 10'000; ++i)
    log.push(servo.step(handAt({2.0 * std::sin(0.001 * i), 0.3, 0.6 - 0.0001 * i}, i > 100), command, 1e-3));
  EXPECT_EQ(allocation_count::now(), before);
}

}  // namespace
}  // namespace haptics
