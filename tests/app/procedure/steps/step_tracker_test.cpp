#include "app/procedure/steps/step_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assets/tissue.h"
#include "haptics/body/bodies.h"

namespace app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Step step(const std::string& key, const DoneWhen& when) {
  Step one;
  one.key = key;
  one.title = "Title of " + key;
  one.instruments = {StepInstrument::bur};
  one.done_when = when;
  return one;
}
Step given(const std::string& key) {
  DoneWhen when;
  when.given = key + " is done";
  return step(key, when);
}
/// Never met.
Step endless(const std::string& key) {
  DoneWhen when;
  when.bone_mm3 = 1e4;
  return step(key, when);
}
StepPlan planOf(std::vector<Step> steps) { return {"own", "Steps", std::move(steps)}; }

/// Ticks of a millisecond.
struct Rehearsed {
  explicit Rehearsed(std::vector<Step> steps) : tracker(planOf(std::move(steps))) { tick.dt_s = 1e-3; }
  void go(int ticks = 1) {
    for (int n = 0; n < ticks; ++n, ++tick.index) {
      tick.t_s = 1e-3 * static_cast<double>(tick.index);
      tracker.follow(tick, facts);
    }
  }
  std::size_t current() const { return tracker.current().value_or(99); }
  StepState state(std::size_t n) const { return tracker.records()[n].state; }

  StepTracker tracker;
  haptics::Tick tick;
  StepFacts facts;
};

/// Not met by `before`, met by `after`.
void expectRule(const DoneWhen& when, const std::function<void(Rehearsed&)>& before, const std::string& missing,
                const std::function<void(Rehearsed&)>& after) {
  Rehearsed run({step("one", when), endless("two")});
  before(run);
  run.go(3);
  EXPECT_EQ(run.current(), 0u) << missing;
  EXPECT_EQ(run.tracker.missing(), missing);
  after(run);
  run.go();
  EXPECT_EQ(run.current(), 1u) << missing;
  EXPECT_EQ(run.state(0), StepState::met);
}

void remove(Rehearsed& run, assets::Tissue tissue, double mm3) {
  run.tick.removed_total_mm3[static_cast<std::size_t>(tissue)] = mm3;
}
void setAside(Rehearsed& run, std::size_t piece) { run.tick.X_PQ[piece].translation_mm = glm::dvec3(10'000.0); }

TEST(StepTracker, MeetsEachRuleByItsFactAlone) {
  DoneWhen when;
  when.crown_bared = 0.7;
  expectRule(
      when, [](Rehearsed& run) { run.facts.crown_bared = 0.69; }, "crown bared 69 of 70 %",
      [](Rehearsed& run) { run.facts.crown_bared = 0.7; });
  when = {};
  when.gutter_removed = 0.5;
  expectRule(
      when, [](Rehearsed& run) { run.facts.crown_bared = 1.0; }, "gutter 0 of 50 %",
      [](Rehearsed& run) { run.facts.gutter_removed = 0.51; });
  when = {};
  when.bone_mm3 = 20.0;
  expectRule(
      when,
      [](Rehearsed& run) {
        remove(run, assets::Tissue::enamel, 50.0);
        remove(run, assets::Tissue::cortical, 12.0);
      },
      "bone 12 of 20 mm³", [](Rehearsed& run) { remove(run, assets::Tissue::trabecular, 8.0); });
  when = {};
  when.tooth_mm3 = 20.0;
  expectRule(
      when, [](Rehearsed& run) { remove(run, assets::Tissue::cortical, 50.0); }, "tooth 0 of 20 mm³",
      [](Rehearsed& run) {
        remove(run, assets::Tissue::enamel, 15.0);
        remove(run, assets::Tissue::dentine, 5.0);
      });
  when = {};
  when.bridge_mm = 3.0;
  expectRule(
      when, [](Rehearsed& run) { run.facts.bridge_mm = 3.1; }, "bridge 3.1 mm, 3.0 at most",
      [](Rehearsed& run) { run.facts.bridge_mm = 3.0; });
  expectRule(
      when, [](Rehearsed& run) { run.tick.pieces = 1; }, "leave 3.0 mm at most",
      [](Rehearsed& run) { run.tick.pieces = 2; });
  when = {};
  when.torn = 0.5;
  expectRule(
      when, [](Rehearsed& run) { run.tick.torn_share = 0.25; }, "ligament torn 25 of 50 %",
      [](Rehearsed& run) { run.tick.torn_share = 0.5; });
  when = {};
  when.pieces = 2;
  expectRule(
      when, [](Rehearsed& run) { run.tick.pieces = 1; }, "1 of 2 pieces", [](Rehearsed& run) { run.tick.pieces = 2; });
  when = {};
  when.pieces_out = 1;
  expectRule(
      when, [](Rehearsed& run) { run.tick.pieces = 2; }, "0 of 1 out", [](Rehearsed& run) { setAside(run, 1); });
  when = {};
  when.all_out = true;
  expectRule(
      when,
      [](Rehearsed& run) {
        run.tick.pieces = 2;
        setAside(run, 1);
      },
      "1 of 2 out", [](Rehearsed& run) { setAside(run, 0); });
  when = {};
  when.in_hand = StepInstrument::forceps;
  expectRule(
      when, [](Rehearsed&) {}, "take the forceps", [](Rehearsed& run) { run.facts.in_hand = StepInstrument::forceps; });
}

TEST(StepTracker, MeetsTheRulesOfASocketOnceItWasLookedAt) {
  const auto socket = [](auto change) {
    return [change](Rehearsed& run) {
      SocketFacts facts{2.0, 0.8, 12.0, false, 0};
      change(facts);
      run.facts.socket = facts;
    };
  };
  DoneWhen when;
  when.chips_mm3 = 0.5;
  expectRule(
      when, [](Rehearsed&) {}, "chips not looked at", socket([](SocketFacts& facts) { facts.chips_mm3 = 0.5; }));
  expectRule(when, socket([](SocketFacts&) {}), "chips 2.0 of 0.5 mm³ at most",
             socket([](SocketFacts& facts) { facts.chips_mm3 = 0.4; }));
  when = {};
  when.follicle_left = 0.1;
  expectRule(when, socket([](SocketFacts&) {}), "follicle 80.0 of 10.0 % at most",
             socket([](SocketFacts& facts) { facts.follicle_left = 0.1; }));
  when = {};
  when.edges_mm = 6.0;
  expectRule(when, socket([](SocketFacts&) {}), "sharp edges 12.0 of 6.0 mm at most",
             socket([](SocketFacts& facts) { facts.edges_mm = 5.9; }));
  when = {};
  when.socket_clean = true;
  expectRule(
      when, [](Rehearsed&) {}, "the socket is not clean", socket([](SocketFacts& facts) { facts.is_clean = true; }));
  when = {};
  when.stitches = 2;
  expectRule(when, socket([](SocketFacts& facts) { facts.stitches = 1; }), "1 of 2 stitches",
             socket([](SocketFacts& facts) { facts.stitches = 2; }));
}

TEST(StepTracker, AskesForAllThatARuleSays) {
  DoneWhen when;
  when.crown_bared = 0.7;
  when.bone_mm3 = 20.0;
  Rehearsed run({step("one", when)});
  run.facts.crown_bared = 0.9;
  run.go();
  EXPECT_EQ(run.tracker.missing(), "bone 0 of 20 mm³");
  EXPECT_TRUE(run.tracker.asksForBone());
  remove(run, assets::Tissue::cortical, 20.0);
  run.go();
  EXPECT_FALSE(run.tracker.current());
  EXPECT_EQ(run.tracker.missing(), "");
  EXPECT_FALSE(run.tracker.asksForBone());
}

TEST(StepTracker, TellsBeginAndEndWithTheirTimes) {
  DoneWhen when;
  when.pieces = 2;
  Rehearsed run({given("flap"), step("cut", when), given("close")});
  run.go(100);
  EXPECT_THAT(run.tracker.takeGiven(), ElementsAre("flap is done"));
  run.tick.pieces = 2;
  run.go(50);
  EXPECT_THAT(run.tracker.takeEvents(),
              ElementsAre("begin flap at 0.001 s: Title of flap", "end flap: given, 0.000 s",
                          "begin cut at 0.001 s: Title of cut", "end cut: met, 0.100 s",
                          "begin close at 0.101 s: Title of close", "end close: given, 0.000 s"));
  EXPECT_THAT(run.tracker.takeGiven(), ElementsAre("close is done"));
  run.tracker.finish();
  EXPECT_TRUE(run.tracker.takeEvents().empty()) << "nothing is open";
}

TEST(StepTracker, AMetStepStaysMetAfterAnUndo) {
  DoneWhen when;
  when.bone_mm3 = 20.0;
  Rehearsed run({step("one", when), endless("two")});
  remove(run, assets::Tissue::cortical, 25.0);
  run.go();
  remove(run, assets::Tissue::cortical, 0.0);
  run.go(10);
  EXPECT_EQ(run.current(), 1u);
  EXPECT_EQ(run.state(0), StepState::met);
}

TEST(StepTracker, APartedToothLeavesEarlierStepsAsOmittedOrMet) {
  DoneWhen bared, bridge, parted;
  bared.crown_bared = 0.7;
  bridge.bridge_mm = 3.0;
  parted.pieces = 2;
  Rehearsed run({step("bone", bared), step("section", bridge), given("mark"), step("split", parted), endless("rest")});
  run.facts.crown_bared = 0.6;
  run.go(10);
  EXPECT_EQ(run.current(), 0u);
  run.tick.pieces = 2;
  run.go();
  EXPECT_EQ(run.state(0), StepState::omitted);
  EXPECT_EQ(run.state(1), StepState::met);
  EXPECT_EQ(run.state(2), StepState::given);
  EXPECT_EQ(run.state(3), StepState::met);
  EXPECT_EQ(run.current(), 4u);
}

TEST(StepTracker, AThinBridgeDoesNotPassOverTheBoneThatIsStillToBeDone) {
  DoneWhen bared, bridge;
  bared.crown_bared = 0.7;
  bridge.bridge_mm = 3.0;
  Rehearsed run({step("bone", bared), step("section", bridge)});
  run.facts.bridge_mm = 1.0;
  run.go(10);
  EXPECT_EQ(run.current(), 0u);
}

TEST(StepTracker, IsSkippedByHand) {
  Rehearsed run({endless("one"), endless("two")});
  EXPECT_FALSE(run.tracker.skip()) << "nothing has begun";
  run.go(10);
  EXPECT_TRUE(run.tracker.skip());
  EXPECT_EQ(run.state(0), StepState::skipped);
  run.go(20);
  EXPECT_TRUE(run.tracker.skip());
  EXPECT_FALSE(run.tracker.skip()) << "all have ended";
  EXPECT_DOUBLE_EQ(run.tracker.records()[1].duration_s, 0.020);
}

TEST(StepTracker, ReportsAtTheEndWhatIsOpenOrWasNotReached) {
  Rehearsed run({endless("one"), endless("two")});
  run.go(10);
  run.tracker.takeEvents();
  run.tracker.finish();
  EXPECT_THAT(run.tracker.takeEvents(), ElementsAre("end one: open, 0.009 s", "end two: not reached: Title of two"));
}

/// Not counted in `before`, once in `after`.
void expectError(StepError error, const StepErrorRules& rules, const std::function<void(Rehearsed&)>& before,
                 const std::function<void(Rehearsed&)>& after) {
  Step one = endless("one");
  one.errors = rules;
  Rehearsed run({one});
  before(run);
  run.go(10);
  EXPECT_TRUE(run.tracker.records()[0].errors.empty()) << wordsOf(error);
  after(run);
  run.go(10);
  EXPECT_THAT(run.tracker.records()[0].errors, ElementsAre(std::pair(std::string(wordsOf(error)), 1)));
  // Without the rule nothing is counted.
  one.errors = {};
  Rehearsed lax({one});
  after(lax);
  lax.go(10);
  EXPECT_TRUE(lax.tracker.records()[0].errors.empty()) << wordsOf(error);
}

void cut(Rehearsed& run) {
  run.tick.drilling = true;
  run.tick.depth_mm = 0.1;
}

TEST(StepTracker, CountsEachErrorByItsFactAlone) {
  StepErrorRules rules;
  rules.dry = true;
  expectError(StepError::dry, rules, cut, [](Rehearsed& run) {
    cut(run);
    run.facts.irrigating = false;
  });
  rules = {};
  rules.soft_tissue = true;
  expectError(
      StepError::soft_tissue, rules,
      [](Rehearsed& run) { run.tick.soft.tissues = assets::bitOf(assets::SoftTissue::cheek); },
      [](Rehearsed& run) { run.tick.soft.bur_cuts = assets::SoftTissue::cheek; });
  rules = {};
  rules.wrong_instrument = true;
  expectError(
      StepError::wrong_instrument, rules, [](Rehearsed& run) { run.facts.in_hand = StepInstrument::forceps; },
      [](Rehearsed& run) {
        run.facts.in_hand = StepInstrument::forceps;
        run.tick.gripped = 1;
      });
  rules = {};
  rules.fulcrum = true;
  expectError(
      StepError::fulcrum, rules, [](Rehearsed& run) { run.tick.lever = {.piece = 1, .on_bone_N = 60.0}; },
      [](Rehearsed& run) { run.tick.lever = {.piece = 1, .on_teeth_N = 60.0}; });
  rules = {};
  rules.nerve_mm = 2.0;
  expectError(
      StepError::near_nerve, rules,
      [](Rehearsed& run) {
        cut(run);
        run.facts.nerve_mm = 2.1;
      },
      [](Rehearsed& run) {
        cut(run);
        run.facts.nerve_mm = 1.9;
      });
  rules = {};
  rules.cutting_N = 10.0;
  expectError(
      StepError::pressed_hard, rules,
      [](Rehearsed& run) {
        run.tick.law_force_P_N = {{0.0, 0.0, 20.0}};
      },
      [](Rehearsed& run) {
        cut(run);
        run.tick.law_force_P_N = {{0.0, 0.0, 11.0}};
      });
  rules = {};
  rules.pull_N = 60.0;
  expectError(
      StepError::pulled_hard, rules,
      [](Rehearsed& run) {
        run.tick.grip_force_P_N = {{0.0, 0.0, 59.0}};
      },
      [](Rehearsed& run) {
        run.tick.gripped = 2;
        run.tick.grip_force_P_N = {{0.0, 0.0, 61.0}};
      });
  rules = {};
  rules.bone_mm3 = 100.0;
  expectError(
      StepError::bone_beyond_limit, rules, [](Rehearsed& run) { remove(run, assets::Tissue::enamel, 300.0); },
      [](Rehearsed& run) { remove(run, assets::Tissue::cortical, 101.0); });
}

TEST(StepTracker, APauseOfAQuarterSecondEndsAnErrorAndAStepsErrorsAreItsOwn) {
  Step one = endless("one"), two = endless("two");
  one.errors.dry = true;
  Rehearsed run({one, two});
  cut(run);
  run.facts.irrigating = false;
  run.go(100);
  run.facts.irrigating = true;
  run.go(200);
  run.facts.irrigating = false;
  run.go(10);
  EXPECT_EQ(run.tracker.records()[0].errors.front().second, 1) << "0.2 s of water";
  run.facts.irrigating = true;
  run.go(300);
  run.facts.irrigating = false;
  run.go(10);
  EXPECT_EQ(run.tracker.records()[0].errors.front().second, 2);
  run.tracker.skip();
  run.go(500);
  EXPECT_TRUE(run.tracker.records()[1].errors.empty());
}

TEST(StepTracker, BlamesTouchesThatTheStepForbids) {
  Step one = endless("one");
  one.errors.neighbour = true;
  Rehearsed run({one});
  run.tracker.blame(StepError::neighbour);
  EXPECT_TRUE(run.tracker.records()[0].errors.empty()) << "nothing has begun";
  run.go();
  run.tracker.blame(StepError::neighbour);
  run.tracker.blame(StepError::canal);
  EXPECT_THAT(run.tracker.records()[0].errors, ElementsAre(std::pair(std::string("neighbour tooth touched"), 1)));
  EXPECT_THAT(run.tracker.takeEvents().back(), HasSubstr("error in one at 0.001 s: neighbour tooth touched"));
}

/// Whatever the facts, steps end in order and once.
TEST(StepTracker, RandomFactsEndStepsInOrderAndOnce) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    std::vector<Step> steps;
    for (int n = 0; n < 6; ++n) {
      DoneWhen when;
      if (n % 3 == 0) when.crown_bared = 0.9 * share(random) + 0.05;
      if (n % 3 == 1) when.torn = 0.9 * share(random) + 0.05;
      if (n % 3 == 2) when.pieces_out = 1 + n / 4;
      steps.push_back(step("s" + std::to_string(n), when));
    }
    Rehearsed run(steps);
    std::size_t at = 0;
    for (int n = 0; n < 60; ++n) {
      run.facts.crown_bared = share(random);
      run.tick.torn_share = share(random);
      run.tick.pieces = 3;
      if (n == 30) setAside(run, 0);
      run.go();
      const std::size_t now = run.tracker.current().value_or(6);
      ASSERT_GE(now, at);
      at = now;
    }
    run.tracker.finish();
    std::optional<ProcedureRun> read;
    addStepEvent(read, procedureText({"own", "free", run.tracker.records()}));
    for (const std::string& event : run.tracker.takeEvents()) addStepEvent(read, event);
    ASSERT_EQ(read->steps.size(), 6u);
    for (std::size_t n = 0; n < 6; ++n) {
      EXPECT_EQ(read->steps[n].key, run.tracker.records()[n].key);
      EXPECT_EQ(read->steps[n].title, run.tracker.records()[n].title);
      EXPECT_EQ(read->steps[n].state, run.tracker.records()[n].state);
      EXPECT_NEAR(read->steps[n].duration_s, run.tracker.records()[n].duration_s, 1e-9);
    }
  }
}

}  // namespace
}  // namespace app
