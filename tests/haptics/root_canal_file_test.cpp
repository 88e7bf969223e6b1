// A root-canal file in the servo: the hand leads it into a canal of closed form, files it, breaks it, undoes.
#include "haptics/servo/root_canal_file.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "haptics/servo/servo.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/file_scene.h"

namespace haptics {
namespace {

constexpr double kTick_s = 1e-3;

/// Servo, tooth and a hand that holds a file over the orifice.
struct Endodontist {
  phantom::CanalWall canal;
  Bodies bodies;
  Servo servo{bodies};
  HandSample hand;
  Command command;
  Tick tick;

  explicit Endodontist(int size = 20, bool is_alloy = false)
      : canal(phantom::bentCanal(0.7)), bodies(CarvedBone(canal.field.grid, canal.field.solid, {})) {
    command.serial = 1;
    command.tool = fileTool({static_cast<std::uint64_t>(size), 21.0, is_alloy});
    command.safety.must_be_armed = false;
    hand.X_PT.translation_mm = {0.0, 0.0, 21.5};
    hand.held = hand.fresh = hand.calibrated = hand.device_healthy = true;
    for (int n = 0; n < 100; ++n) step();
  }
  void step() { tick = servo.step(hand, command, kTick_s); }
  void move(double down_mm, double turn_rad = 0.0) {
    hand.X_PT.translation_mm.z -= down_mm;
    hand.X_PT.rotation = glm::normalize(hand.X_PT.rotation * glm::angleAxis(turn_rad, glm::dvec3(0.0, 0.0, -1.0)));
    hand.velocity_P_mm_per_s.xyz = {0.0, 0.0, -down_mm / kTick_s};
    step();
  }
  void push(double to_mm, double step_mm = 0.01) {
    while (21.0 - hand.X_PT.translation_mm.z < to_mm) move(step_mm);
  }
  void strokes(int count) {
    for (int stroke = 0; stroke < count; ++stroke)
      for (const double way_mm : {-0.03, 0.03})
        for (int n = 0; n < 50; ++n) move(way_mm);
  }
  double removed_mm3() const { return tick.removed_total_mm3[0]; }
};

TEST(RootCanalFile, IsLedDownItsCanalAndFelt) {
  Endodontist at;
  EXPECT_EQ(at.tick.file.stay, FileStay::free);
  EXPECT_EQ(glm::length(at.tick.law_force_P_N.xyz), 0.0);
  at.push(15.0);
  EXPECT_EQ(at.tick.file.stay, FileStay::wall);
  EXPECT_GT(at.tick.law_force_P_N.xyz.z, 0.2);
  // The tip lies in the canal.
  const double along_mm = at.canal.canal.nearest_mm(at.tick.file.tip_P_mm);
  EXPECT_GT(along_mm, 13.0);
  EXPECT_LT(glm::length(at.tick.file.tip_P_mm - at.canal.canal.at(along_mm).p_mm), at.canal.canal.radius_mm(along_mm));
  EXPECT_GT(at.tick.file.strain, 0.01);
  // What is felt is a spring of at most 0.8 N/mm, whatever the wall.
  EXPECT_NEAR(glm::length(at.tick.law_force_P_N.xyz),
              kFileCoupling_N_per_mm * glm::length(at.tick.proxy_P.mm - at.hand.X_PT.translation_mm), 1e-9);
  // The last node is the tip, the first the handle.
  EXPECT_LT(glm::length(glm::dvec3(at.tick.file.node_P_mm[kUsualLinks]) - at.tick.file.tip_P_mm), 1e-5);
  EXPECT_LT(glm::length(glm::dvec3(at.tick.file.node_P_mm[0]) - at.tick.proxy_P.mm), 1e-5);
}

TEST(RootCanalFile, TakesWhatItsLawSaysAndTellsIt) {
  Endodontist at(15);
  at.push(15.0);
  at.strokes(10);
  for (int n = 0; n < 40; ++n) at.move(0.0);
  EXPECT_GT(at.removed_mm3(), 0.001);
  EXPECT_NEAR(at.tick.file.removed_total_mm3, at.removed_mm3(), 1e-12) << "as the bone has it";
  EXPECT_NEAR(at.tick.file.removed_total_mm3 / at.tick.file.due_total_mm3, 1.0, 0.01);
  // Another file goes on with the same books.
  const double before_mm3 = at.tick.file.removed_total_mm3;
  at.push(-0.5, -0.03);
  while (at.hand.X_PT.translation_mm.z < 21.5) at.move(-0.03);
  at.command.tool = fileTool({25, 21.0});
  ++at.command.serial;
  at.step();
  EXPECT_GE(at.tick.file.removed_total_mm3, before_mm3);
}

TEST(RootCanalFile, RunsAgainToTheLastBit) {
  std::vector<std::uint64_t> digests;
  std::vector<double> forces;
  for (int run = 0; run < 2; ++run) {
    Endodontist at;
    at.push(14.0);
    for (int n = 0; n < 300; ++n) {
      at.move(n % 100 < 50 ? 0.02 : -0.02, n % 60 < 30 ? 0.01 : -0.01);
      if (run == 0) {
        digests.push_back(at.tick.bone_digest);
        forces.push_back(at.tick.law_force_P_N.xyz.x);
      } else {
        ASSERT_EQ(at.tick.bone_digest, digests[static_cast<std::size_t>(n)]) << n;
        ASSERT_EQ(at.tick.law_force_P_N.xyz.x, forces[static_cast<std::size_t>(n)]) << n;
      }
    }
  }
  EXPECT_NE(digests.front(), digests.back());
}

TEST(RootCanalFile, OpenFingersTurnWithoutIt) {
  Endodontist at;
  at.push(12.0);
  for (int n = 0; n < 100; ++n) at.move(0.0, 0.01);
  const double turned_rad = at.tick.file.roll_rad;
  EXPECT_NEAR(turned_rad, 1.0, 0.02);
  at.hand.drill_pedal = true;
  for (int n = 0; n < 100; ++n) at.move(0.0, -0.01);
  EXPECT_NEAR(at.tick.file.roll_rad, turned_rad, 1e-6) << "the handle stays";
  at.hand.drill_pedal = false;
  for (int n = 0; n < 100; ++n) at.move(0.0, 0.01);
  EXPECT_NEAR(at.tick.file.roll_rad, turned_rad + 1.0, 0.02) << "and is turned on";
}

TEST(RootCanalFile, AnUndoPutsBackWhatAStrokeTookAndTheFileHasNoForceUntilItIsOut) {
  Endodontist at;
  at.push(15.0);
  const std::uint64_t untouched = at.tick.bone_digest;
  // What it took on its way in belongs to the strokes too.
  at.command.wear.alpha_mm3_per_Nmm = 3e-3;
  ++at.command.serial;
  at.push(-0.5, -0.03);
  while (at.hand.X_PT.translation_mm.z < 21.5) at.move(-0.03);
  at.push(15.0);
  at.strokes(10);
  for (int n = 0; n < 600; ++n) at.move(0.0);
  ASSERT_GT(at.tick.strokes, 0);
  const double removed_mm3 = at.removed_mm3();
  EXPECT_NE(at.tick.bone_digest, untouched);
  ++at.command.undo_serial;
  ++at.command.serial;
  for (int n = 0; n < 50; ++n) at.move(0.0);
  EXPECT_LT(at.removed_mm3(), removed_mm3);
  EXPECT_EQ(at.tick.file.stay, FileStay::through);
  EXPECT_EQ(glm::length(at.tick.law_force_P_N.xyz), 0.0);
  while (at.hand.X_PT.translation_mm.z < 21.5) at.move(-0.03);
  EXPECT_EQ(at.tick.file.stay, FileStay::free);
  at.push(14.0);
  EXPECT_EQ(at.tick.file.stay, FileStay::wall) << "and meets the wall again";
}

TEST(RootCanalFile, TurnedTooFarItBreaksAndIsToldOnce) {
  Endodontist at(25);
  at.push(15.3);
  int ticks = 0;
  double share = 0.0;
  for (; ticks < 3000 && at.tick.file.broken_from_tip_mm == 0.0; ++ticks) {
    share = at.tick.file.torque_share;
    at.move(0.0, 0.029);
  }
  const double from_tip_mm = at.tick.file.broken_from_tip_mm;
  ASSERT_GT(from_tip_mm, 0.0);
  EXPECT_GT(share, 0.9) << "just before";
  EXPECT_NEAR(at.tick.file.left_mm, 21.0 - from_tip_mm, 1e-9);
  for (int n = 0; n < 100; ++n) {
    at.move(0.0, 0.029);
    EXPECT_EQ(at.tick.file.broken_from_tip_mm, 0.0) << "told once";
  }
}

TEST(RootCanalFile, AllocatesNothing) {
  Endodontist at;
  at.push(14.5);
  const std::size_t before = allocation_count::onThisThread();
  at.strokes(3);
  at.command.tool = fileTool({15, 21.0});
  ++at.command.serial;
  for (int n = 0; n < 50; ++n) at.step();
  EXPECT_EQ(allocation_count::onThisThread(), before);
}

/// Whatever it is told: finite, within the limits of the device.
TEST(RootCanalFile, StaysWithinTheDevicesLimitsWhateverTheHandDoes) {
  Endodontist at;
  phantom::WanderingHand wandering(7, {at.hand.X_PT.rotation, {0.0, 0.0, 21.0}}, 18.0);
  std::mt19937 random(3);
  double strongest_N = 0.0;
  for (int n = 0; n < 6000; ++n) {
    const FilePose next = wandering.next();
    at.hand.X_PT = {next.rotation, next.translation_mm};
    if (n % 500 == 499) at.hand.X_PT.translation_mm += glm::dvec3(0.0, 2.0, 5.0);
    if (n % 700 == 699) at.command.tool = fileTool({random() % 2 == 0 ? 10u : 30u, 25.0, random() % 2 == 0, 30.0});
    if (n % 701 == 700) at.hand.X_PT.translation_mm.x = std::numeric_limits<double>::quiet_NaN();
    at.hand.drill_pedal = random() % 50 == 0;
    at.step();
    const double force_N = glm::length(at.tick.commanded_force_P_N.xyz);
    ASSERT_TRUE(std::isfinite(force_N)) << n;
    strongest_N = std::max(strongest_N, force_N);
  }
  EXPECT_LE(strongest_N, at.command.safety.peak_force_N + 1e-9);
  EXPECT_GT(strongest_N, 0.1);
}

}  // namespace
}  // namespace haptics
