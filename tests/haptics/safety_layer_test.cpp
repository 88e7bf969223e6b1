// The whole layer under hands, devices, laws and clocks that nobody should have.
#include "haptics/safety/safety_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace haptics {
namespace {

using calibration::Patient;

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

/// A Touch with motors.
SafetyLimits touch() {
  SafetyLimits limits = strict({});
  limits.peak_force_N = 2.97;
  limits.peak_torque_Nmm = 0.0;
  limits.continuous_force_N = 0.88;
  limits.peak_joint_torque_Nmm = glm::dvec3(350.0);
  return limits;
}

/// What Delivery does of it: motion of the handle from believed hand to believed hand.
struct Bench {
  SafetyLayer layer;
  SafetyLimits limits = touch();
  SafetyLayer::Admitted admitted;
  SafetyFilter::Delivered served;
  glm::dvec3 last_place_mm{0.0}, last_N{0.0};
  std::uint64_t rearm = 0;
  double given_Nmm = 0.0;
  bool touches = false;
  glm::dvec3 tremble_N{0.0};

  double tick(const HandSample& hand, const glm::dvec3& wanted_N, double dt_s, double max_stored_Nmm = 50.0) {
    admitted = layer.admit(hand, limits, rearm, dt_s);
    const glm::dvec3 position_mm = admitted.hand.X_PT.translation_mm + admitted.hand.arm_P_mm.xyz;
    SafetyLayer::Request wish;
    wish.wrench_P.force_N.xyz = wanted_N;
    if (!admitted.relocated) wish.motion.travel_P_mm.xyz = position_mm - last_place_mm;
    wish.vibration_P_N.xyz = tremble_N;
    wish.max_stored_Nmm = max_stored_Nmm;
    wish.touches = touches;
    served = layer.serve(wish, limits, dt_s);
    const glm::dvec3 now_N = served.wrench_P.force_N.xyz;
    given_Nmm += 0.5 * glm::dot(now_N + last_N, wish.motion.travel_P_mm.xyz);
    last_place_mm = position_mm;
    last_N = now_N;
    return glm::length(now_N);
  }
  /// A hand at rest in air until the force is on.
  void arm(double dt_s = 1e-3) {
    for (double t = 0.0; t < 0.8; t += dt_s) tick({}, glm::dvec3(0.0), dt_s);
    ASSERT_EQ(admitted.state, SafetyState::active);
  }
};

constexpr glm::dvec3 kPush(0.0, 0.0, 2.0);

TEST(SafetyLayer, GivesNothingBeforeTheHandIsArmedAndThenStartsSoftly) {
  Bench bench;
  bench.touches = true;
  for (int tick = 0; tick < 1000; ++tick) ASSERT_EQ(bench.tick({}, kPush, 1e-3), 0.0);
  bench.touches = false;
  double last_N = 0.0;
  int until_whole = 0;
  for (int tick = 0; tick < 700; ++tick) {
    const double now_N = bench.tick({}, kPush, 1e-3);
    ASSERT_LE(now_N - last_N, 5e-3 + 1e-12);
    if (now_N < 1.9) ++until_whole;
    last_N = now_N;
  }
  EXPECT_NEAR(until_whole, 0.95 * 594, 8);
}

TEST(SafetyLayer, TakesTheForceAwayInTheVeryTickOfDockingStopUnplugAndRunaway) {
  const auto after = [](auto&& change) {
    Bench bench;
    bench.arm();
    for (int tick = 0; tick < 100; ++tick) bench.tick({}, kPush, 1e-3);
    EXPECT_NEAR(glm::length(bench.last_N), 2.0, 1e-9);
    HandSample hand;
    change(hand);
    return bench.tick(hand, kPush, 1e-3);
  };
  EXPECT_EQ(after([](HandSample& h) { h.docked = true; }), 0.0);
  EXPECT_EQ(after([](HandSample& h) { h.stop_requested = true; }), 0.0);
  EXPECT_EQ(after([](HandSample& h) { h.device_healthy = false; }), 0.0);
  EXPECT_EQ(after([](HandSample& h) { h.calibrated = false; }), 0.0);
  EXPECT_EQ(after([](HandSample& h) { h.gap_s = 0.03; }), 0.0);
  EXPECT_EQ(after([](HandSample& h) { h.handle_velocity_P_mm_per_s.xyz.x = 1200.0; }), 0.0);
  EXPECT_NEAR(after([](HandSample& h) { h.motor_heat = 1.0; }), 0.6, 1e-9);
  EXPECT_NEAR(after([](HandSample& h) { h.X_PT.translation_mm.x = kNan; }), 1.0, 1e-9);
  EXPECT_NEAR(after([](HandSample& h) { h.held = false; }), 2.0 * 0.98, 1e-9);
}

TEST(SafetyLayer, HoldsTheForceOfAStaleHandForFiveMillisecondsAndHasLetGoAfterTwenty) {
  for (double rate_Hz : {500.0, 1000.0, 10'000.0}) {
    const double dt_s = 1.0 / rate_Hz;
    Bench bench;
    bench.arm(dt_s);
    for (double t = 0.0; t < 0.1; t += dt_s) bench.tick({}, kPush, dt_s);
    HandSample stale;
    stale.fresh = false;
    for (int tick = 1; tick * dt_s < 0.03; ++tick) {
      // The law makes up something new meanwhile: it is not listened to.
      const double age_s = tick * dt_s, now_N = bench.tick(stale, age_s > 0.003 + 1e-9 ? -kPush : kPush, dt_s);
      ASSERT_NEAR(now_N, 2.0 * std::clamp((0.02 - age_s) / 0.015, 0.0, 1.0), 1e-6) << age_s;
    }
    EXPECT_TRUE(has(bench.admitted.faults, Fault::latched));
  }
}

TEST(SafetyLayer, LatchesThreeBadSamplesUntilTheInstructorLiftsThem) {
  Bench bench;
  bench.arm();
  HandSample bad;
  bad.X_PT.translation_mm.x = kNan;
  for (int tick = 0; tick < 3; ++tick) bench.tick(bad, kPush, 1e-3);
  EXPECT_TRUE(has(bench.admitted.faults, Fault::latched));
  for (int tick = 0; tick < 2000; ++tick) ASSERT_EQ(bench.tick({}, kPush, 1e-3), 0.0);
  bench.rearm = 1;
  for (int tick = 0; tick < 700; ++tick) bench.tick({}, kPush, 1e-3);
  EXPECT_NEAR(glm::length(bench.last_N), 2.0, 1e-9);
}

TEST(SafetyLayer, PutsNoForceOfItsOwnOnAHandThatIsLeftAlone) {
  Bench bench;
  bench.arm();
  for (int tick = 0; tick < 1000; ++tick) {
    HandSample hand;
    hand.handle_velocity_P_mm_per_s.xyz = {500.0 * std::sin(0.01 * tick), 0.0, 0.0};
    ASSERT_EQ(bench.tick(hand, glm::dvec3(0.0), 1e-3), 0.0);
  }
}

TEST(SafetyLayer, TakesAGimbalsNoiseAtTheToolsEndForNoShaking) {
  // 0.2 degrees to and fro every tick, 40 mm in front of the gimbal: 140 mm/s at the tool, nothing at the handle.
  Bench bench;
  bench.arm();
  for (int tick = 0; tick < 500; ++tick) {
    HandSample hand;
    hand.velocity_P_mm_per_s.xyz.x = tick % 2 == 0 ? 70.0 : -70.0;
    bench.tick(hand, kPush, 1e-3);
  }
  EXPECT_GT(glm::length(bench.last_N), 0.73) << "as much as the motors' heat allows";
  EXPECT_FALSE(has(bench.served.faults, Fault::buzz));
}

TEST(SafetyLayer, DrillsOnlyWhereTheHandFeels) {
  Bench bench;
  bench.tick({}, {}, 1e-3);
  EXPECT_FALSE(bench.admitted.mayDrill());
  bench.arm();
  EXPECT_TRUE(bench.admitted.mayDrill());
  HandSample hand;
  hand.held = false;
  bench.tick(hand, {}, 1e-3);
  EXPECT_FALSE(bench.admitted.mayDrill());
}

/// Everything at once, at random, with long stretches in which all is well.
class HostileWorld {
 public:
  HostileWorld(unsigned seed, double rate_Hz) : random_(seed), rate_Hz_(rate_Hz) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double part) { return uniform(0.0, 1.0) < part; }
  glm::dvec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

  double dt_s() { return chance(0.02) ? uniform(0.05, 1.9) / rate_Hz_ : 1.0 / rate_Hz_; }

  HandSample hand(double dt_s) {
    if (chance(2.0 * dt_s)) calm_ = !calm_;
    if (chance(8.0 * dt_s)) speed_ = vector(chance(0.1) ? 2500.0 : calm_ ? 25.0 : 300.0);
    if (glm::length(place_) > 400.0) speed_ = -0.1 * place_;
    place_ += dt_s * speed_;
    HandSample hand;
    hand.X_PT.translation_mm = place_;
    hand.handle_velocity_P_mm_per_s.xyz = speed_;
    hand.jacobian_P_mm = {vector(140.0), vector(140.0), vector(140.0)};
    hand.motor_heat = heat_ = std::clamp(heat_ + uniform(-0.02, 0.02), 0.0, 1.2);
    // Each a run of its own.
    hand.fresh = !run(stale_, 0.6 * dt_s, 0.03, dt_s);
    hand.docked = run(docked_, 0.05 * dt_s, 0.1, dt_s);
    hand.held = !run(let_go_, 0.3 * dt_s, 0.1, dt_s);
    hand.calibrated = !run(lost_, 0.02 * dt_s, 0.1, dt_s);
    hand.device_healthy = !run(unwell_, 0.05 * dt_s, 0.05, dt_s);
    if (chance(0.1 * dt_s)) hand.gap_s = chance(0.1) ? kNan : uniform(0.0, 0.05);
    if (run(mad_, 0.5 * dt_s, 0.003, dt_s)) {
      double* numbers[] = {&hand.X_PT.translation_mm.x, &hand.handle_velocity_P_mm_per_s.xyz.y,
                           &hand.jacobian_P_mm[1].z,    &hand.X_PT.rotation.w,
                           &hand.arm_P_mm.xyz.z,        &hand.motor_heat};
      const double values[] = {kNan, kInf, -kInf, 1e300, -1e9, 50.0};
      *numbers[random_() % 6] = values[random_() % 6];
    }
    if (run(shaking_, 0.05 * dt_s, 0.3, dt_s))
      hand.handle_velocity_P_mm_per_s.xyz.x = (shake_ = !shake_) ? 90.0 : -90.0;
    return hand;
  }

  glm::dvec3 wanted_N(const glm::dvec3& position_mm, double dt_s) {
    if (chance(10.0 * dt_s)) kind_ = static_cast<int>(random_() % 6), push_ = vector(4.0), home_ = position_mm;
    switch (kind_) {
      case 0:
        return -0.8 * (position_mm - home_);
      case 1:
        return push_;
      case 2:
        return vector(6.0);
      case 3:
        return glm::length(speed_) > 0.0 ? 3.0 * glm::normalize(speed_) : push_;
      case 4:
        return chance(0.2) ? glm::dvec3(chance(0.5) ? kNan : kInf, 0.0, 1e300) : push_;
      default:
        return 1e3 * push_;
    }
  }

 private:
  /// True while a run of at most `longest_s` lasts, which begins with the chance given.
  bool run(double& left_s, double chance_to_begin, double longest_s, double dt_s) {
    if (left_s <= 0.0 && chance(chance_to_begin)) left_s = uniform(0.0, longest_s);
    left_s -= dt_s;
    return left_s > 0.0;
  }

  std::mt19937 random_;
  double rate_Hz_, heat_ = 0.0;
  glm::dvec3 place_{0.0}, speed_{0.0}, push_{0.0}, home_{0.0};
  double stale_ = 0.0, docked_ = 0.0, let_go_ = 0.0, lost_ = 0.0, unwell_ = 0.0, mad_ = 0.0, shaking_ = 0.0;
  int kind_ = 0;
  bool calm_ = true, shake_ = false;
};

TEST(SafetyLayer, KeepsEveryLimitInAMillionHostileTicks) {
  std::uint64_t with_force = 0;
  Fault seen = Fault::none;
  unsigned seed = 0;
  for (double rate_Hz : {500.0, 1000.0, 1000.0, 4000.0, 10'000.0}) {
    HostileWorld world(++seed, rate_Hz);
    Bench bench;
    double stale_s = 0.0, last_N = 0.0;
    bool stopped = false;
    constexpr int kTicks = 220'000;
    for (int tick = 0; tick < kTicks; ++tick) {
      const double dt_s = world.dt_s();
      HandSample hand = world.hand(dt_s);
      hand.stop_requested = tick == kTicks - 10'000;
      stopped = stopped || hand.stop_requested;
      if (world.chance(3.0 * dt_s)) ++bench.rearm;
      if (world.chance(4.0 * dt_s)) bench.touches = world.chance(0.5);
      bench.tremble_N = world.chance(0.01) ? glm::dvec3(kNan, 0.0, kInf) : world.vector(0.2);
      const double now_N = bench.tick(hand, world.wanted_N(bench.last_place_mm, dt_s), dt_s);
      stale_s = hand.fresh ? 0.0 : stale_s + dt_s;

      ASSERT_TRUE(std::isfinite(now_N)) << tick;
      ASSERT_LE(now_N, bench.limits.peak_force_N * (1.0 + 1e-12)) << tick;
      ASSERT_LE(now_N - last_N, 300.0 * dt_s * (1.0 + 1e-9)) << tick;
      const glm::dvec3 joints_Nmm = glm::transpose(bench.admitted.hand.jacobian_P_mm) * bench.last_N;
      for (int joint = 0; joint < 3; ++joint) ASSERT_LE(std::abs(joints_Nmm[joint]), 350.0 * (1.0 + 1e-9)) << tick;
      if (bench.admitted.state != SafetyState::active || stopped || stale_s > 0.02 - 1e-9) {
        ASSERT_EQ(now_N, 0.0) << tick;
      }
      if (hand.docked || !hand.calibrated || !hand.device_healthy) {
        ASSERT_EQ(now_N, 0.0) << tick;
      }
      ASSERT_GE(bench.layer.energy_Nmm(), -PassivityController::kMaxDebt_Nmm) << tick;
      ASSERT_TRUE(std::isfinite(bench.layer.energy_Nmm())) << tick;
      with_force += now_N > 0.01;
      seen = seen | bench.admitted.faults | bench.served.faults;
      last_N = now_N;
    }
  }
  EXPECT_GT(with_force, 100'000u) << "the world lets the hand feel something";
  EXPECT_EQ(static_cast<std::uint32_t>(seen), 0xffffu) << "and everything that can trip has tripped";
}

TEST(SafetyLayer, KeepsTheMeanSquareOverTenSecondsUnderHostileHands) {
  HostileWorld world(77, 1000.0);
  Bench bench;
  std::vector<double> squares;
  double sum = 0.0, most = 0.0;
  for (int tick = 0; tick < 120'000; ++tick) {
    HandSample hand;
    hand.motor_heat = tick % 30'000 < 5000 ? 0.9 : 0.0;
    hand.held = tick % 7000 > 100;
    const double now_N = bench.tick(hand, tick % 9000 < 6000 ? glm::dvec3(9.0, 0.0, 0.0) : world.vector(3.0), 1e-3);
    squares.push_back(now_N * now_N * 1e-3);
    sum += squares.back();
    if (squares.size() > 10'000) sum -= squares[squares.size() - 10'001];
    most = std::max(most, sum);
  }
  EXPECT_LE(std::sqrt(most / 10.0), 0.88 * (1.0 + 1e-6));
  EXPECT_GT(std::sqrt(most / 10.0), 0.5);
}

/// Energy that a hand as fast as `fastest` gets on balance, ever, from laws that would drive engines with it, while
/// deadman, heat and soft start change what is let through.
double mostGiven_Nmm(unsigned seed, double rate_Hz, double max_speed_mm_per_s, double seconds) {
  HostileWorld world(seed, rate_Hz);
  Bench bench;
  bench.limits.continuous_force_N = seed % 2 == 0 ? 1e3 : 0.88;
  bench.arm(1.0 / rate_Hz);
  const double dt_s = 1.0 / rate_Hz;
  glm::dvec3 place(0.0), speed(0.0), target(0.0), wish_N(0.0), home(0.0);
  double most_Nmm = 0.0, sign = 1.0;
  int kind = 0;
  bool held = true;
  for (int tick = 0; tick < static_cast<int>(seconds * rate_Hz); ++tick) {
    if (world.chance(6.0 * dt_s)) target = world.vector(max_speed_mm_per_s / std::sqrt(3.0));
    if (glm::length(place) > 60.0) target = -2.0 * place;
    if (const double most = max_speed_mm_per_s; glm::length(target) > most) target *= most / glm::length(target);
    speed += (target - speed) * std::min(1.0, 60.0 * dt_s);
    place += speed * dt_s;
    if (world.chance(15.0 * dt_s)) kind = static_cast<int>(world.uniform(0.0, 4.0)), home = place;
    if (world.chance(30.0 * dt_s)) sign = -sign;
    const glm::dvec3 along = glm::length(speed) > 1e-9 ? glm::normalize(speed) : glm::dvec3(1.0, 0.0, 0.0);
    wish_N = kind == 0   ? 2.9 * along                                  // an engine
             : kind == 1 ? 2.9 * sign * along                           // brakes, then pushes
             : kind == 2 ? (sign < 0.0 ? -1.6 : -0.4) * (place - home)  // a spring that stiffens where it is pressed
                         : -0.8 * (place - home);
    if (world.chance(2.0 * dt_s)) held = !held;
    HandSample hand;
    hand.X_PT.translation_mm = place;
    hand.handle_velocity_P_mm_per_s.xyz = speed;
    hand.held = held || tick % static_cast<int>(0.2 * rate_Hz) < static_cast<int>(0.16 * rate_Hz);
    hand.motor_heat = tick % static_cast<int>(0.9 * rate_Hz) < static_cast<int>(0.3 * rate_Hz) ? 0.95 : 0.2;
    hand.docked = tick % static_cast<int>(5.0 * rate_Hz) == 0;
    bench.tick(hand, wish_N, dt_s);
    most_Nmm = std::max(most_Nmm, bench.given_Nmm);
  }
  return most_Nmm;
}

TEST(SafetyLayer, NeverFeedsAHandWhateverLawAndGainsDo) {
  // The debt at which it lets go, and what one tick of the fastest motion can take at the peak.
  unsigned seed = 0;
  for (double rate_Hz : {1000.0, 4000.0, 10'000.0})
    for (int run = 0; run < 3; ++run) {
      const double fastest = 300.0, tolerance_Nmm = PassivityController::kReleaseDebt_Nmm + 2.97 * fastest / rate_Hz;
      EXPECT_LE(mostGiven_Nmm(++seed, rate_Hz, fastest, 60.0 * 1000.0 / rate_Hz), tolerance_Nmm) << rate_Hz;
    }
}

TEST(SafetyLayer, BoundsWhatTheWorstHandOfTwoMetresASecondCanTake) {
  for (double rate_Hz : {500.0, 1000.0, 10'000.0})
    for (unsigned seed = 20; seed < 23; ++seed) {
      HostileWorld world(seed, rate_Hz);
      Bench bench;
      bench.limits.continuous_force_N = 1e3;
      const double dt_s = 1.0 / rate_Hz;
      bench.arm(dt_s);
      glm::dvec3 place(0.0), wish_N(0.0);
      double most_Nmm = 0.0, seconds = 0.0;
      for (int tick = 0; tick < 60'000; ++tick) {
        // Waits until the force is up, then runs off with it, wherever it points, and lies about its velocity.
        if (world.chance(20.0 * dt_s)) wish_N = 2.9 * glm::normalize(world.vector(1.0));
        const double now_N = glm::length(bench.last_N);
        const bool runs = tick % 64 >= 32 && now_N > 1e-6;
        if (runs) place += 1.999 * 1000.0 * dt_s * bench.last_N / now_N;
        HandSample hand;
        hand.X_PT.translation_mm = place;
        bench.tick(hand, wish_N, dt_s);
        seconds += dt_s;
        most_Nmm = std::max(most_Nmm, bench.given_Nmm - 9.0 * seconds);
      }
      // All there is at once, and what is forgiven of it in the long run.
      EXPECT_LE(most_Nmm, PassivityController::kMaxDebt_Nmm) << rate_Hz;
    }
}

}  // namespace
}  // namespace haptics
