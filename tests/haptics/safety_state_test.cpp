#include "haptics/safety/safety_state.h"

#include <gtest/gtest.h>

#include <random>

namespace haptics {
namespace {

/// The state machine of a device with motors, and its inputs.
struct Bench {
  SafetyLimits limits = strict({});
  SafetyStateMachine machine;
  SafetyStateMachine::Inputs inputs;

  Bench() { inputs.touches = false; }
  SafetyState tick(int times = 1) {
    SafetyState state{};
    for (int i = 0; i < times; ++i) state = machine.update(inputs, limits, 1e-3);
    return state;
  }
};

TEST(SafetyStateMachine, GoesFromOffThroughReadyAndArmedToActive) {
  Bench bench;
  EXPECT_EQ(bench.machine.state(), SafetyState::off);
  bench.inputs.calibrated = false;
  EXPECT_EQ(bench.tick(3), SafetyState::calibrate);
  bench.inputs.calibrated = true;
  EXPECT_EQ(bench.tick(), SafetyState::ready);
  EXPECT_EQ(bench.tick(), SafetyState::armed);
  EXPECT_EQ(bench.tick(), SafetyState::active);
}

TEST(SafetyStateMachine, ArmsOnlyOutsideTissueAtRestAndOutOfTheInkwell) {
  const auto after = [](auto&& change) {
    Bench bench;
    change(bench.inputs);
    return bench.tick(100);
  };
  EXPECT_EQ(after([](SafetyStateMachine::Inputs& s) { s.touches = true; }), SafetyState::ready);
  EXPECT_EQ(after([](SafetyStateMachine::Inputs& s) { s.docked = true; }), SafetyState::ready);
  EXPECT_EQ(after([](SafetyStateMachine::Inputs& s) { s.speed_mm_per_s = 50.1; }), SafetyState::ready);
  EXPECT_EQ(after([](SafetyStateMachine::Inputs& s) { s.speed_mm_per_s = 49.9; }), SafetyState::active);
  EXPECT_EQ(after([](SafetyStateMachine::Inputs& s) { s.held = false; }), SafetyState::armed);
}

TEST(SafetyStateMachine, IsArmedNoLongerOnceTheToolIsInTissue) {
  Bench bench;
  bench.inputs.held = false;
  EXPECT_EQ(bench.tick(3), SafetyState::armed);
  bench.inputs.touches = true;
  EXPECT_EQ(bench.tick(), SafetyState::ready);
  bench.inputs.held = true;
  EXPECT_EQ(bench.tick(100), SafetyState::ready) << "in tissue nothing begins";
}

TEST(SafetyStateMachine, GoesBackToReadyAtOnceWhenDockedOrAfterAPause) {
  for (bool pause : {false, true}) {
    Bench bench;
    ASSERT_EQ(bench.tick(5), SafetyState::active);
    (pause ? bench.inputs.resumed : bench.inputs.docked) = true;
    EXPECT_EQ(bench.tick(), SafetyState::ready);
  }
}

TEST(SafetyStateMachine, LetsGoInFiftyMillisecondsWhenTheDeadmanFeelsNoHand) {
  for (double dt_s : {2e-3, 1e-3, 1e-4}) {
    Bench bench;
    ASSERT_EQ(bench.tick(5), SafetyState::active);
    bench.inputs.held = false;
    double s = 0.0;
    while (bench.machine.update(bench.inputs, bench.limits, dt_s) == SafetyState::active && s < 1.0) {
      EXPECT_TRUE(bench.machine.isReleasing());
      s += dt_s;
    }
    EXPECT_NEAR(s, 0.05, 1.01 * dt_s);
    EXPECT_FALSE(bench.machine.isReleasing());
  }
  Bench taken_again;
  ASSERT_EQ(taken_again.tick(5), SafetyState::active);
  taken_again.inputs.held = false;
  taken_again.tick(30);
  taken_again.inputs.held = true;
  EXPECT_EQ(taken_again.tick(200), SafetyState::active);
}

TEST(SafetyStateMachine, LatchesAFaultUntilTheInstructorLiftsItAndItsCauseIsOver) {
  Bench bench;
  ASSERT_EQ(bench.tick(5), SafetyState::active);
  bench.inputs.trouble = true;
  EXPECT_EQ(bench.tick(), SafetyState::fault);
  bench.inputs.rearm = 1;
  EXPECT_EQ(bench.tick(), SafetyState::fault) << "the cause is still there";
  bench.inputs.trouble = false;
  EXPECT_EQ(bench.tick(1000), SafetyState::fault) << "that word is spent";
  bench.inputs.rearm = 2;
  EXPECT_EQ(bench.tick(), SafetyState::ready);
}

TEST(SafetyStateMachine, IsOffForGoodAfterAStop) {
  for (bool motors : {false, true}) {
    Bench bench;
    bench.limits.must_be_armed = motors;
    ASSERT_EQ(bench.tick(5), SafetyState::active);
    bench.inputs.stop_requested = true;
    EXPECT_EQ(bench.tick(), SafetyState::off);
    bench.inputs = {};
    bench.inputs.rearm = 9;
    EXPECT_EQ(bench.tick(1000), SafetyState::off);
  }
}

TEST(SafetyStateMachine, IsActiveAtOnceWhereNobodyCanBePushed) {
  Bench bench;
  bench.limits = {};
  bench.inputs.touches = true;
  bench.inputs.speed_mm_per_s = 900.0;
  EXPECT_EQ(bench.tick(), SafetyState::active);
  bench.inputs.trouble = true;
  EXPECT_EQ(bench.tick(), SafetyState::fault);
  bench.inputs.trouble = false;
  EXPECT_EQ(bench.tick(), SafetyState::active);
}

TEST(SafetyStateMachine, IsNeverActiveWithoutHavingBeenArmedWhateverIsSeen) {
  std::mt19937 random(8);
  const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
  Bench bench;
  SafetyState last = SafetyState::off;
  int active = 0, faults = 0;
  for (int tick = 0; tick < 1'000'000; ++tick) {
    SafetyStateMachine::Inputs& s = bench.inputs;
    s.trouble = tick % 997 < 3;
    s.calibrated = !(tick % 4001 < 50);
    if (chance(2)) s.docked = chance(10);
    if (chance(2)) s.held = chance(80);
    s.resumed = chance(0) || tick % 1501 == 0;
    if (chance(2)) s.touches = chance(40);
    if (chance(5)) s.speed_mm_per_s = chance(50) ? 10.0 : 200.0;
    if (chance(1)) s.rearm += chance(50);
    const SafetyState now = bench.tick();
    if (now == SafetyState::active && last != SafetyState::active) {
      ASSERT_EQ(last, SafetyState::armed);
    }
    if (now == SafetyState::armed && last != SafetyState::armed) {
      ASSERT_FALSE(s.touches || s.docked || s.speed_mm_per_s >= 50.0);
    }
    if (now == SafetyState::active || now == SafetyState::armed) {
      ASSERT_FALSE(s.docked || s.trouble || s.resumed || !s.calibrated);
    }
    active += now == SafetyState::active;
    faults += now == SafetyState::fault;
    last = now;
  }
  EXPECT_GT(active, 10'000);
  EXPECT_GT(faults, 10'000);
}

}  // namespace
}  // namespace haptics
