#include "app/session/measures/clearance_measures.h"

#include <gtest/gtest.h>

#include "tests/app/session/measures/measure_named.h"
#include "tests/haptics/structure_phantom.h"

namespace app {
namespace {

using test::named;

using haptics::phantom::ToolPose;

constexpr std::size_t kCanal = 0, kLingual = 1, kSecond = 2;

assets::RiskStructures canalAndCrown() {
  assets::RiskStructures risks;
  risks.distance[kCanal] = haptics::phantom::canal(0.25).distance();
  risks.distance[kSecond] = haptics::phantom::crown(0.25).distance();
  return risks;
}

class Way {
 public:
  explicit Way(const assets::RiskStructures& risks) : measures(risks) {}

  void tick(const ToolPose& X_PT, bool drilling, const haptics::Tool& tool) {
    haptics::Tick tick;
    tick.dt_s = 0.001;
    tick.t_s = 0.001 * n++;
    tick.proxy_P.mm = X_PT.translation_mm;
    tick.hand.X_PT = X_PT;
    tick.drilling = drilling;
    measures.add(tick, tool);
  }

  ClearanceMeasures measures;
  int n = 0;
};

const haptics::Tool kRound{{haptics::ShapeKind::sphere, 1.0, 0.0}, {}};

TEST(ClearanceMeasures, StoppingThreeMillimetresOffIsTwo) {
  const assets::RiskStructures risks = canalAndCrown();
  Way way(risks);
  const glm::dvec3 axis(-8.0, 0.0, 0.0);
  for (int n = 0; n <= 2000; ++n)
    way.tick({glm::dquat(1, 0, 0, 0), axis - glm::dvec3(0.0, 0.0, 6.5 - 0.001 * n)}, true, kRound);
  const MeasureValue least = named(way.measures.values(), "S1.canal");
  ASSERT_TRUE(least.value);
  EXPECT_NEAR(*least.value, 2.0, 0.5 * 0.25);
  EXPECT_NEAR(*least.t_s, 2.0, 0.01);
  EXPECT_EQ(least.unit, "mm");
  EXPECT_NE(least.conditions.find("0.25"), std::string::npos);
}

TEST(ClearanceMeasures, TellForceAndSpeedAtTheNearest) {
  const assets::RiskStructures risks = canalAndCrown();
  ClearanceMeasures measures(risks);
  for (int n = 0; n <= 1000; ++n) {
    haptics::Tick tick;
    tick.dt_s = 0.001;
    tick.t_s = 0.001 * n;
    // 5 mm/s towards the canal for half a second, then back; the force rises all the time.
    tick.proxy_P.mm = {-8.0, 0.0, -(8.0 - 0.005 * (n <= 500 ? n : 1000 - n))};
    tick.hand.X_PT.translation_mm = tick.proxy_P.mm;
    tick.law_force_P_N.xyz = {0.0, 0.0, 0.004 * n};
    tick.drilling = true;
    measures.add(tick, kRound);
  }
  const auto values = measures.values();
  EXPECT_NEAR(*named(values, "S1.canal").t_s, 0.5, 0.01);
  EXPECT_NEAR(*named(values, "S1.canal_force").value, 2.0, 0.04);
  EXPECT_NEAR(*named(values, "S1.canal_speed").value, 5.0, 0.01);
  EXPECT_EQ(named(values, "S1.canal_speed").unit, "mm/s");
}

TEST(ClearanceMeasures, TellNoSpeedOfABurThatHasJustBegunToTurn) {
  const assets::RiskStructures risks = canalAndCrown();
  ClearanceMeasures measures(risks);
  haptics::Tick tick;
  tick.dt_s = 0.001;
  tick.drilling = true;
  tick.proxy_P.mm = tick.hand.X_PT.translation_mm = {-8.0, 0.0, -6.0};
  measures.add(tick, kRound);
  const auto values = measures.values();
  EXPECT_TRUE(named(values, "S1.canal").value);
  EXPECT_FALSE(named(values, "S1.canal_speed").value);
  EXPECT_EQ(named(values, "S1.canal_speed").why, "the bur had just begun to turn");
}

TEST(ClearanceMeasures, ARampOfFourMillimetresIsOneTwoAndFourSecondsInTheBands) {
  const assets::RiskStructures risks = canalAndCrown();
  Way way(risks);
  for (int n = 0; n < 5000; ++n)
    way.tick({glm::dquat(1, 0, 0, 0), {-8.0, 0.0, -(2.5 + 5.0 - 0.001 * n)}}, true, kRound);
  const auto values = way.measures.values();
  EXPECT_NEAR(*named(values, "S2.canal_1mm").value, 1.0, 0.13);
  EXPECT_NEAR(*named(values, "S2.canal_2mm").value, 2.0, 0.13);
  EXPECT_NEAR(*named(values, "S2.canal_4mm").value, 4.0, 0.13);
}

TEST(ClearanceMeasures, CountTheTurningBurAlone) {
  const assets::RiskStructures risks = canalAndCrown();
  Way way(risks);
  const ToolPose near{glm::dquat(1, 0, 0, 0), {-8.0, 0.0, -3.0}};
  way.tick(near, false, kRound);
  way.tick(near, true, haptics::elevatorTool(haptics::ElevatorKind::straight_301));
  EXPECT_FALSE(way.measures.least()[kCanal]);
  EXPECT_FALSE(named(way.measures.values(), "S1.canal").value);
  EXPECT_EQ(named(way.measures.values(), "S1.canal").why, "the drill was not on");
  way.tick(near, true, kRound);
  EXPECT_TRUE(way.measures.least()[kCanal]);
  EXPECT_FALSE(way.measures.least()[kLingual]);
  EXPECT_FALSE(named(way.measures.values(), "S1.lingual").why.empty());
}

/// What is left out changes nothing.
TEST(ClearanceMeasures, AreThoseOfEveryTick) {
  const assets::RiskStructures risks = canalAndCrown();
  std::mt19937 random(21);
  std::normal_distribution<double> step(0.0, 0.03);
  Way way(risks);
  double least_mm = 1e9, near_s = 0.0;
  ToolPose X_PT{glm::dquat(1, 0, 0, 0), {-8.0, 5.0, -6.0}};
  const haptics::Tool cylinder{{haptics::ShapeKind::cylinder, 0.8, 4.0}, {0.5, 20.0}};
  glm::dvec3 pull(0.0);
  for (int n = 0; n < 6000; ++n) {
    pull = 0.98 * pull + 0.02 * (glm::dvec3(-6.0 + 6.0 * std::sin(0.002 * n), 4.0 + 3.0 * std::sin(0.003 * n), 0.0) -
                                 X_PT.translation_mm);
    X_PT.translation_mm += 0.02 * pull + glm::dvec3(step(random), step(random), step(random));
    X_PT.rotation = glm::normalize(X_PT.rotation * glm::dquat(1.0, 0.1 * step(random), 0.1 * step(random), 0.0));
    const haptics::Tool& tool = n / 1000 % 2 == 0 ? kRound : cylinder;
    way.tick(X_PT, true, tool);
    const double mm = haptics::clearance_mm(risks.distance[kCanal], tool, X_PT);
    least_mm = std::min(least_mm, mm);
    if (mm < 2.0) near_s += 0.001;
  }
  EXPECT_DOUBLE_EQ(way.measures.least()[kCanal]->mm, least_mm);
  EXPECT_NEAR(*named(way.measures.values(), "S2.canal_2mm").value, near_s, 1e-9);
  EXPECT_GT(near_s, 0.1);
  EXPECT_LT(near_s, 5.9);
}

}  // namespace
}  // namespace app
