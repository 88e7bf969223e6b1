#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "haptics/ligament/piece_hold.h"
#include "tests/haptics/ligament_scene.h"

namespace haptics {
namespace {

PieceHold freshRoots(const LigamentLaw& law = {}) { return {arranged(phantom::twoRoots(0.5)), law}; }

/// Neither fluid nor creep nor yield.
LigamentLaw elasticLaw() {
  LigamentLaw law;
  law.fluid_N_per_mm2 = 0.0;
  law.creep_s = 1e9;
  law.yield_N_per_mm2 = 1e9;
  law.drag_Ns_per_mm = 1e-4;
  return law;
}

struct Pull {
  double most_N = 0.0, work_Nmm = 0.0, torn_Nmm = 0.0, stored_Nmm = 0.0;
};

/// Straight up at 0.5 mm/s to 0.9 mm, guided.
Pull pulled(PieceHold hold, double period_s) {
  Pull pull;
  double force_N = 0.0, z_mm = 0.0;
  for (double to_mm = 0.0; to_mm < 0.9; to_mm += 0.5 * period_s) {
    const HoldTick tick = hold.step(phantom::pulledUp(to_mm), nullptr, period_s);
    const double now_N = -tick.on_hand.force_N.xyz.z;
    pull.work_Nmm += 0.5 * (now_N + force_N) * (tick.X_PQ.translation_mm.z - z_mm);
    force_N = now_N;
    z_mm = tick.X_PQ.translation_mm.z;
    pull.most_N = std::max(pull.most_N, now_N);
    pull.torn_Nmm += tick.torn_Nmm;
    pull.stored_Nmm = tick.stored_Nmm;
  }
  return pull;
}

TEST(LigamentTearing, TakesTheEnergyOfItsLawAndOfItsHand) {
  const PieceHold hold = freshRoots(elasticLaw());
  const double area_mm2 = hold.samples().ligamentArea_mm2();
  const Pull pull = pulled(hold, 1e-3);
  EXPECT_NEAR((pull.torn_Nmm + pull.stored_Nmm) / pull.work_Nmm, 1.0, 0.01);
  EXPECT_NEAR(pull.torn_Nmm / (LigamentLaw{}.tearEnergy_Nmm_per_mm2(0.2) * area_mm2), 1.0, 0.01);
  EXPECT_NEAR(area_mm2, 248.0, 1.5);
}

TEST(LigamentTearing, HoldsItsPeakStressOverItsArea) {
  const PieceHold hold = freshRoots(elasticLaw());
  const double most_N = LigamentLaw{}.peakStress_N_per_mm2() * hold.samples().ligamentArea_mm2();
  EXPECT_NEAR(pulled(hold, 1e-3).most_N / most_N, 1.0, 0.01);
}

TEST(LigamentTearing, IsTheSameCurveAtEveryRate) {
  const Pull usual = pulled(freshRoots(), 1e-3);
  for (const double period_s : {4e-3, 2e-3, 0.5e-3, 0.25e-3}) {
    const Pull pull = pulled(freshRoots(), period_s);
    EXPECT_NEAR(pull.most_N / usual.most_N, 1.0, 0.02) << period_s;
    EXPECT_NEAR(pull.torn_Nmm / usual.torn_Nmm, 1.0, 0.02) << period_s;
    EXPECT_NEAR(pull.work_Nmm / usual.work_Nmm, 1.0, 0.02) << period_s;
  }
}

/// Ticks of 5 ms until all is torn under a vertical load, at most `most`.
int ticksUnder(double force_N, int most) {
  PieceHold hold = freshRoots();
  PieceDrive drive;
  drive.force_N.xyz.z = force_N;
  double torn = 0.0;
  for (int n = 0; n < most; ++n) {
    const HoldTick tick = hold.step(drive, nullptr, 5e-3);
    EXPECT_GE(tick.torn_share, torn - 1e-6) << "it never heals";
    torn = tick.torn_share;
    if (torn > 0.9) return n;
  }
  return most;
}

TEST(LigamentTearing, CreepsOutTheSoonerTheMoreItBears) {
  const int at_350 = ticksUnder(350.0, 24000), at_450 = ticksUnder(450.0, 24000), at_550 = ticksUnder(550.0, 24000);
  EXPECT_EQ(ticksUnder(150.0, 6000), 6000);
  EXPECT_GT(at_350, at_450);
  EXPECT_GT(at_450, at_550);
  EXPECT_NEAR(at_450 * 5e-3, 15.0, 2.0) << "as the reference has it";
}

TEST(LigamentTearing, RockingLoosensIt) {
  PieceHold hold = freshRoots();
  PieceDrive drive;
  double share = 0.0;
  for (int n = 0; n < 8000; ++n) {
    drive.torque_Nmm.xyz.x = 3000.0 * std::sin(2.0 * std::numbers::pi * n * 1e-3);
    share = hold.step(drive, nullptr, 1e-3).torn_share;
  }
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 1.0);
}

/// A closed way of the hand: smooth, from rest to rest.
struct ClosedWay {
  std::array<std::array<double, 3>, 6> part{};

  ClosedWay(std::mt19937& random, double way_mm, double turn_rad) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::size_t n = 0; n < 6; ++n)
      for (double& harmonic : part[n]) harmonic = unit(random) * (n < 3 ? way_mm : turn_rad) / 2.0;
  }
  PiecePose at(double share) const {
    std::array<double, 6> value{};
    for (std::size_t n = 0; n < 6; ++n)
      for (std::size_t h = 0; h < 3; ++h)
        value[n] += part[n][h] * std::sin(std::numbers::pi * static_cast<double>(h + 1) * share);
    return {glm::normalize(glm::dquat(1.0, 0.5 * glm::dvec3(value[3], value[4], value[5]))),
            {value[0], value[1], value[2]}};
  }
};

TEST(LigamentTearing, NoClosedWayOfTheHandGainsEnergy) {
  const phantom::SocketScene scene = phantom::rootInSocket();
  const DistanceField bone(scene.bone.grid, scene.bone.solid, 1.6);
  std::mt19937 random(11);
  double least_Nmm = 0.0;
  int ticks = 0, unsettled = 0;
  for (int loop = 0; loop < 60; ++loop) {
    const bool in_bone = loop % 2 == 1;
    PieceHold hold = in_bone ? scene.hold(bone) : freshRoots();
    const double size = 0.1 + 0.05 * (loop % 10);
    const ClosedWay way(random, size, 0.1 * size);
    PieceDrive drive;
    drive.spring.stiffness_N_per_mm = 300.0;
    drive.spring.stiffness_Nmm_per_rad = 1e4;
    double work_Nmm = 0.0, torn_Nmm = 0.0;
    Wrench<calibration::Patient> before{};
    constexpr int kTicks = 400;
    for (int n = 1; n <= kTicks; ++n, ++ticks) {
      const PiecePose from = drive.spring.target_X_PQ;
      drive.spring.target_X_PQ = way.at(static_cast<double>(n) / kTicks);
      const HoldTick tick = hold.step(drive, in_bone ? &bone : nullptr, 1e-3);
      const glm::dquat turn = drive.spring.target_X_PQ.rotation * glm::conjugate(from.rotation);
      // What the hand does on the spring's other end.
      work_Nmm -= 0.5 * glm::dot(tick.on_hand.force_N.xyz + before.force_N.xyz,
                                 drive.spring.target_X_PQ.translation_mm - from.translation_mm) +
                  glm::dot(tick.on_hand.torque_Nmm.xyz + before.torque_Nmm.xyz, glm::dvec3(turn.x, turn.y, turn.z));
      before = tick.on_hand;
      torn_Nmm += tick.torn_Nmm;
      unsettled += tick.unsettled ? 1 : 0;
      EXPECT_GE(tick.torn_Nmm, 0.0);
    }
    least_Nmm = std::min(least_Nmm, work_Nmm - 0.95 * torn_Nmm);
  }
  EXPECT_GE(least_Nmm, -0.05);
  EXPECT_LE(unsettled, ticks / 1000) << "of " << ticks;
}

TEST(LigamentTearing, RandomHandsAlwaysSettle) {
  const PieceHold fresh = freshRoots();
  int unsettled = 0, torn_out = 0;
  constexpr int kHands = 20, kTicks = 1000;
  for (unsigned seed = 0; seed < kHands; ++seed) {
    PieceHold hold = fresh;
    phantom::RandomHand hand(seed, 0.1 + 0.05 * seed, 0.01 + 0.005 * seed);
    double torn = 0.0;
    for (int n = 0; n < kTicks; ++n) {
      torn = hold.step(hand.next(), nullptr, 1e-3).torn_share;
    }
    torn_out += torn > 0.9 ? 1 : 0;
    unsettled += hold.unsettled();
  }
  EXPECT_EQ(unsettled, 0) << "of " << kHands * kTicks;
  EXPECT_GT(torn_out, 0);
  EXPECT_LT(torn_out, kHands);
}

TEST(LigamentTearing, InputThatIsNoNumberChangesNothing) {
  PieceHold hold = freshRoots();
  PieceDrive good = phantom::pulledUp(0.1);
  hold.step(good, nullptr, 1e-3);
  const PieceState before = hold.state();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::array<PieceDrive, 7> drives{good, good, good, good, good, good, good};
    drives[0].force_N.xyz.y = bad;
    drives[1].torque_Nmm.xyz.z = -bad;
    drives[2].load_at_P.mm.x = bad;
    drives[3].spring.grip_Q.mm.x = bad;
    drives[4].spring.target_X_PQ.translation_mm.y = bad;
    drives[5].spring.target_X_PQ.rotation.w = bad;
    drives[6].spring.stiffness_N_per_mm = bad;
    for (const PieceDrive& drive : drives) EXPECT_TRUE(hold.step(drive, nullptr, 1e-3).refused);
    EXPECT_TRUE(hold.step(good, nullptr, bad).refused);
  }
  EXPECT_TRUE(hold.step(good, nullptr, 0.0).refused);
  EXPECT_EQ(hold.state().X_PQ.translation_mm, before.X_PQ.translation_mm);
  EXPECT_EQ(hold.state().ligament.torn, before.ligament.torn);

  // A finite force beyond all measure keeps the piece finite.
  good.force_N.xyz.x = 1e300;
  for (int n = 0; n < 50; ++n) hold.step(good, nullptr, 1e-3);
  EXPECT_TRUE(calibration::isFinite(hold.state().X_PQ.translation_mm));
}

TEST(LigamentTearing, SpringEndsAtItsBounds) {
  PieceHold hold = freshRoots();
  PieceDrive drive = phantom::pulledUp(5.0, 1e3, 1e5);
  drive.spring.most_force_N = 100.0;
  drive.spring.most_torque_Nmm = 500.0;
  drive.spring.target_X_PQ.rotation = glm::normalize(glm::dquat(1.0, 0.3, 0.0, 0.0));
  HoldTick tick;
  for (int n = 0; n < 100; ++n) tick = hold.step(drive, nullptr, 1e-3);
  EXPECT_NEAR(glm::length(tick.on_hand.force_N.xyz), 100.0, 1e-6);
  EXPECT_NEAR(glm::length(tick.on_hand.torque_Nmm.xyz), 500.0, 1e-6);
  EXPECT_FALSE(tick.unsettled);
}

TEST(LigamentTearing, RestoredStateGoesOnWithTheSameBits) {
  PieceHold hold = freshRoots();
  for (int n = 0; n < 50; ++n) hold.step(phantom::pulledUp(4e-3 * n), nullptr, 1e-3);
  const PieceState saved = hold.state();
  const HoldTick once = hold.step(phantom::pulledUp(0.25), nullptr, 1e-3);
  hold.restore(saved);
  const HoldTick again = hold.step(phantom::pulledUp(0.25), nullptr, 1e-3);
  EXPECT_EQ(once.X_PQ.translation_mm, again.X_PQ.translation_mm);
  EXPECT_EQ(once.X_PQ.rotation, again.X_PQ.rotation);
  EXPECT_EQ(once.torn_Nmm, again.torn_Nmm);
}

}  // namespace
}  // namespace haptics
