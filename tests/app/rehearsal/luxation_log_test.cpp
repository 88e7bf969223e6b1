#include "app/rehearsal/luxation_log.h"

#include <gtest/gtest.h>

#include <utility>

namespace app {
namespace {

struct Told {
  LuxationLog log;
  haptics::Tick tick;
  bool ready = true;

  Told() { tick.dt_s = 0.001; }
  std::vector<std::string> lines(int ticks = 1) {
    std::vector<std::string> lines;
    const std::vector<haptics::Tick> all(static_cast<std::size_t>(ticks), tick);
    for (const LuxationLog::Told& told : log.follow(all, true, ready, [](std::size_t) { return 411.6; }))
      lines.push_back(told.line);
    return lines;
  }
};
using Lines = std::vector<std::string>;

TEST(LuxationLog, TellsWhyNothingIsHeldOnceForEachClosing) {
  Told told;
  EXPECT_EQ(told.lines(), Lines{});
  told.tick.hand.drill_pedal = true;
  EXPECT_EQ(told.lines(3), Lines{"nothing between the beaks"});
  EXPECT_EQ(told.lines(), Lines{});
  told.tick.hand.drill_pedal = false;
  told.lines();
  told.tick.hand.drill_pedal = true;
  told.ready = false;
  EXPECT_EQ(told.lines(), Lines{"the forceps are not ready yet, open them and wait"});
  EXPECT_EQ(told.log.summary(), "");
}

TEST(LuxationLog, TellsTheBridgeThatBroke) {
  Told told;
  told.tick.hand.drill_pedal = true;
  told.tick.gripped = 1;
  told.tick.bridge_share = 0.6;
  EXPECT_EQ(luxationText(told.tick, haptics::forcepsTool(), true), "bridge 60 %");
  told.tick.broken = {1, true, 12.3, 172.6, 451.0};
  EXPECT_EQ(told.lines(), Lines{"the bridge of 12 mm² broke at 173 N, 0.45 N m"});
  told.tick.broken.is_complete = false;
  EXPECT_EQ(told.lines(), Lines{"the bridge of 12 mm² broke at 173 N, 0.45 N m, not clean: a spur stays on the root"});
  EXPECT_NE(told.log.summary().find(", 2 bridges broken, held for"), std::string::npos) << told.log.summary();
}

TEST(LuxationLog, TellsQuartersOfTheLigamentThenWhatCameOut) {
  Told told;
  told.tick.hand.drill_pedal = true;
  told.tick.gripped = 2;
  told.tick.grip_force_P_N.xyz = {0.0, 0.0, 120.0};
  told.tick.torn_share = 0.2;
  EXPECT_EQ(told.lines(1000), Lines{});
  told.tick.torn_share = 0.55;
  EXPECT_EQ(told.lines(1000), Lines{"50 % of the ligament is torn"});
  told.tick.torn_share = 0.9995;
  told.tick.grip_force_P_N.xyz = {};
  EXPECT_EQ(told.lines(1000), Lines{"the piece is loose"});
  EXPECT_EQ(told.log.summary(),
            "nothing taken out, held for 0:03, pulled with 120 N at most (model), 100 % of the ligament torn");
  told.tick.gripped = 0;
  told.tick.pieces = 2;
  told.tick.X_PQ[1].translation_mm = glm::dvec3(10'000.0);
  told.tick.hand.drill_pedal = false;
  EXPECT_EQ(told.lines(), Lines{"out: a piece of 412 mm³"});
  EXPECT_EQ(told.log.summary().rfind("412 mm³ taken out, held for 0:03", 0), 0u) << told.log.summary();
}

TEST(LuxationLog, TakesBackWhatIsUndone) {
  Told told;
  told.tick.pieces = 2;
  told.tick.gripped = 2;
  told.tick.torn_share = 0.6;
  EXPECT_EQ(told.lines(), Lines{"50 % of the ligament is torn"});
  told.tick.gripped = 0;
  const auto home = told.tick.X_PQ[1];
  told.tick.X_PQ[1].translation_mm = glm::dvec3(10'000.0);
  EXPECT_EQ(told.lines(3), Lines{"out: a piece of 412 mm³"});
  const auto away = std::exchange(told.tick.X_PQ[1], home);
  told.tick.torn_share = 0.1;
  EXPECT_EQ(told.lines(3), Lines{"back in the mouth: a piece of 412 mm³"});
  EXPECT_EQ(told.log.summary(),
            "nothing taken out, held for 0:00, pulled with 0 N at most (model), 10 % of the ligament torn");
  told.tick.gripped = 2;
  EXPECT_EQ(told.lines(), Lines{});
  told.tick.torn_share = 0.55;
  EXPECT_EQ(told.lines(3), Lines{"50 % of the ligament is torn"}) << "told again";
  told.tick.gripped = 0;
  told.tick.X_PQ[1] = away;
  EXPECT_EQ(told.lines(), Lines{"out: a piece of 412 mm³"}) << "redone";
  EXPECT_EQ(told.log.summary().rfind("412 mm³ taken out", 0), 0u) << told.log.summary();
}

TEST(LuxationLog, TellsWhatAnElevatorDoes) {
  Told told;
  told.tick.lever.piece = 1;
  told.tick.lever.twist_Nmm = -620.0;
  told.tick.torn_share = 0.3;
  EXPECT_EQ(told.lines(1000), Lines{"25 % of the ligament is torn"});
  EXPECT_EQ(told.log.summary(),
            "nothing taken out, levered for 0:01 with 0.62 N m at most (model), 30 % of the ligament torn");
}

TEST(LuxationLog, TellsOfANeighbouringToothThatBearsTheElevator) {
  Told told;
  told.tick.lever = {1, 100.0, 10.0, 30.0, 40.0, 0.0, {}};
  EXPECT_EQ(told.lines(40), Lines{}) << "shorter than 50 ms";
  told.tick.lever.on_teeth_N = 0.0;
  EXPECT_EQ(told.lines(), Lines{});
  told.tick.lever.on_teeth_N = 30.0;
  EXPECT_EQ(told.lines(60), Lines{"the elevator rests on a neighbouring tooth"});
  told.tick.lever.on_teeth_N = 44.0;
  EXPECT_EQ(told.lines(60), Lines{});
  told.tick.lever.on_teeth_N = 0.0;
  EXPECT_EQ(told.lines(3), Lines{"a neighbouring tooth bore 44 N of the elevator (model)"});
  EXPECT_NE(told.log.summary().find(", a neighbouring tooth bore 44 N (model), "), std::string::npos);
}

}  // namespace
}  // namespace app
