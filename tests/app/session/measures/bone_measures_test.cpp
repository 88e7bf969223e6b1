#include "app/session/measures/bone_measures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "app/session/measures/outcome.h"
#include "app/session/measures/plan_comparison.h"
#include "haptics/servo/servo.h"
#include "tests/app/session/real_session.h"

namespace app {
namespace {

/// A block of bone with a plan: a box at its surface, and a neighbour of the operated tooth on one side.
class BoneMeasuresTest : public testing::Test {
 protected:
  BoneMeasuresTest() {
    start_.dt_s = 0.001;
    start_.grid = block_.grid;
    start_.solid = block_.solid;
    start_.label = block_.label;
    start_.teeth.assign(block_.solid.size(), 0);
    start_.setup.site.emplace();
    start_.setup.site->fdi = 48;
    assets::forVoxels(block_.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ijk.x > 26) start_.teeth[v] = 47;
    });
    about_.plan.emplace();
    about_.plan->outward_P = {0.0, 0.0, 1.0}, about_.plan->lateral_P = {0.0, 1.0, 0.0};
    about_.from_plan_mm = [](const glm::dvec3& p) {
      const glm::dvec3 q = glm::abs(p) - glm::dvec3(1.5, 1.0, 0.5);
      return std::max({q.x, q.y, q.z});
    };
  }

  /// The servo sweeps; every so many ticks a stroke is undone. `look` after each tick.
  void rehearse(std::uint64_t ticks, const std::function<void(const haptics::Tick&, const haptics::Command&)>& look) {
    haptics::Servo servo(bodies_);
    haptics::Command command = block_.start().command;
    for (std::uint64_t n = 0; n < ticks; ++n) {
      if (n % 700 == 650) ++command.undo_serial, ++command.serial;
      haptics::HandSample hand = test::sweepingHand(static_cast<double>(n) * 0.001);
      // Off the bone where a stroke is undone, deeper from time to time.
      if (n % 700 > 600) hand.X_PT.translation_mm.z = 4.0, hand.drill_pedal = false;
      hand.X_PT.translation_mm.z -= n > 1500 ? 0.3 : 0.0;
      look(servo.step(hand, command, 0.001), command);
    }
  }

  test::BoneBlock block_;
  StoredStart start_;
  SessionCase about_;
  haptics::Bodies bodies_{block_.grid, block_.solid, block_.label};
};

std::vector<std::string> allIds() {
  std::vector<std::string> ids;
  for (const MeasureName& one : outcomeNames()) ids.emplace_back(one.id);
  return ids;
}

TEST_F(BoneMeasuresTest, SumsAreOfEveryTickAndThoseOfASlowCount) {
  BoneMeasures measures(start_, about_, bodies_, {"O2.plan", "O3.over", "O10.second_molar", "O1.bone"});
  std::size_t looked = 0, grew = 0, fell = 0;
  double before = 0.0;
  rehearse(2500, [&](const haptics::Tick& tick, const haptics::Command& command) {
    measures.add(tick, command, bodies_);
    const double plan = measures.values()[0].value_or(0.0);
    grew += plan > before ? 1 : 0, fell += plan < before ? 1 : 0;
    before = plan;
    if (tick.index % 37 != 0 || !(tick.removed_mm3 != 0.0)) return;
    ++looked;
    const std::vector<std::uint8_t> after = bodies_.solidInMouth();
    const PlanComparison slow = compareWithPlan(
        block_.grid, block_.solid, after, [&](std::size_t v) { return countsAsBone(block_.label[v]); },
        about_.from_plan_mm);
    double second_molar = 0.0;
    for (std::size_t v = 0; v < after.size(); ++v)
      if (start_.teeth[v] == 47) second_molar += lostShare(block_.solid[v], after[v]);
    ASSERT_NEAR(*measures.values()[0], slow.both_mm3 / slow.planned_mm3, 1e-12) << tick.index;
    ASSERT_NEAR(*measures.values()[1], slow.over_mm3(), 1e-10) << tick.index;
    ASSERT_NEAR(*measures.values()[2], second_molar * block_.grid.voxelVolume_mm3(), 1e-10) << tick.index;
    ASSERT_NEAR(*measures.values()[3], slow.removed_mm3, 1e-10) << tick.index;
  });
  EXPECT_GT(looked, 15u);
  EXPECT_GT(grew, 300u);
  EXPECT_GT(fell, 0u) << "undone";
  EXPECT_GT(before, 0.2);
}

TEST_F(BoneMeasuresTest, TheWholeCutIsOfEveryHalfSecondAndAsTheOutcomeHasIt) {
  BoneMeasures measures(start_, about_, bodies_, allIds());
  std::vector<std::optional<double>> last;
  std::size_t told = 0;
  rehearse(2501, [&](const haptics::Tick& tick, const haptics::Command& command) {
    measures.add(tick, command, bodies_);
    if (tick.index % 500 != 0) return;
    const std::vector<std::uint8_t> after = bodies_.solidInMouth();
    const RemovalClock clock(block_.grid, block_.solid, after);
    const OriginalSurface surface(block_.grid, block_.solid);
    const std::optional<SocketRecord> none;
    for (const MeasureValue& value : outcomeMeasures({start_, after, clock, &surface, about_, none, {}})) {
      // Of the tooth its tissues tell, and a bridge is told of a tooth alone.
      if (value.id == "O1.tooth" || value.id.starts_with("O9.")) continue;
      const auto place = std::ranges::find(measures.ids(), value.id) - measures.ids().begin();
      const std::optional<double> live = measures.values()[static_cast<std::size_t>(place)];
      // Nothing removed is 0 live from the first tick on.
      if (value.value) ++told;
      ASSERT_EQ(live.has_value(), value.value.has_value()) << value.id << " " << tick.index << " " << value.why;
      if (live) {
        ASSERT_NEAR(*live, *value.value, 1e-9) << value.id << " " << tick.index;
      }
    }
  });
  EXPECT_GT(told, 80u);
  EXPECT_TRUE(
      measures
          .values()[static_cast<std::size_t>(std::ranges::find(measures.ids(), "O7.depth") - measures.ids().begin())]);
}

TEST_F(BoneMeasuresTest, WhatTheCaseDoesNotTellHasNoValue) {
  about_.from_plan_mm = {}, about_.plan.reset();
  start_.teeth.clear();
  BoneMeasures measures(start_, about_, bodies_, {"O2.plan", "O10.second_molar", "O5.count", "O11.count", "O1.bone"});
  rehearse(600,
           [&](const haptics::Tick& tick, const haptics::Command& command) { measures.add(tick, command, bodies_); });
  for (const std::size_t n : {0, 1, 2, 3}) EXPECT_FALSE(measures.values()[n]) << measures.ids()[n];
  EXPECT_GT(*measures.values()[4], 0.0);
}

}  // namespace
}  // namespace app
