#include "app/debrief/session_story.h"

#include <cmath>

#include <gtest/gtest.h>

#include "app/session/step_event.h"
#include "app/session/touch_event.h"
#include "tests/app/session/small_session.h"

namespace app {
namespace {

haptics::Tick tickAt(std::uint64_t index, double force_N) {
  haptics::Tick tick = test::imaginedTick(index);
  tick.proxy_P.mm = {0.001 * static_cast<double>(index), 0.0, 0.0};
  tick.law_force_P_N.xyz = {0.0, force_N, 0.0};
  tick.restored_total_mm3 = index >= 2500 ? 1.0 : 0.0;
  return tick;
}

/// 4 s, the force rising by 1 N/s; another tool from 2 s on.
SessionStory story(const assets::RiskStructures& risks) {
  StepRecord step{.key = "gutter", .title = "Cut the gutter"};
  step.begin_s = 1.0;
  SessionStory made({{100, "quality", "step 2"},
                     {1000, kStepEvent, stepBeginText(step)},
                     {1200, "coach", "shorter strokes"},
                     {1300, kTouchEvent, touchText({"lower right third molar", 0.1})},
                     {1400, kTouchEvent, touchText({"mandibular canal", 0.1})},
                     {1500, kStepEvent, stepErrorText(step, "cutting dry", 1.5)},
                     {1600, "snapshot", "/a/path/of/somebody.png"}},
                    risks);
  haptics::Command command;
  for (std::uint64_t n = 0; n < 4000; ++n) {
    if (n == 2000) command.tool.head.radius_mm = 0.8;
    made.follow(tickAt(n, 1e-3 * static_cast<double>(n)), command);
  }
  return made;
}

TEST(SessionStory, MarksWhatIsWorthIt) {
  const assets::RiskStructures none;
  const SessionStory told = story(none);
  std::vector<std::pair<MarkKind, int>> marks;
  for (const SessionMark& mark : told.marks())
    marks.emplace_back(mark.kind, static_cast<int>(std::lround(1e3 * mark.t_s)));
  EXPECT_EQ(marks, (std::vector<std::pair<MarkKind, int>>{{MarkKind::step, 1000},
                                                          {MarkKind::coach, 1200},
                                                          {MarkKind::touch, 1150},
                                                          {MarkKind::error, 1500},
                                                          {MarkKind::tool, 2000},
                                                          {MarkKind::undo, 2500}}));
  EXPECT_EQ(told.marks()[0].what, "Cut the gutter");
  EXPECT_EQ(told.marks()[3].what, "cutting dry");
}

TEST(SessionStory, SamplesTheWayFiftyTimesASecond) {
  const assets::RiskStructures none;
  const SessionStory told = story(none);
  EXPECT_NEAR(static_cast<double>(told.samples().size()), 200.0, 1.0);
  EXPECT_NEAR(told.mostForce_N(), 4.0, 0.03);
  const auto last = told.samplesBefore(3.0, 1.0);
  ASSERT_EQ(last.size(), 50u);
  EXPECT_NEAR(static_cast<double>(last.front().t_s), 2.0, 0.021);
  EXPECT_LT(last.back().t_s, 3.0F);
  EXPECT_TRUE(told.samplesBefore(-1.0, 1.0).empty());
}

TEST(SessionStory, ColoursTheTrailByForce) {
  std::vector<StorySample> samples;
  for (int n = 0; n < 9; ++n) {
    StorySample sample;
    sample.at_P_mm = {0.5F * static_cast<float>(n), 0.0F, 0.0F};
    sample.force_N = 0.6F * static_cast<float>(n);
    sample.level = n > 6 ? assets::RiskLevel::red : assets::RiskLevel::none;
    samples.push_back(sample);
  }
  samples.push_back(samples.back());
  const auto beads = trailOf(samples, TrailColour::force);
  ASSERT_EQ(beads.size(), 9u) << "a tool at rest leaves one ball";
  EXPECT_EQ(beads[0].number, 0u);
  EXPECT_EQ(beads[3].number, 1u);
  EXPECT_EQ(beads[5].number, 2u);
  EXPECT_EQ(beads[8].number, 3u);
  EXPECT_EQ(trailOf(samples, TrailColour::clearance)[8].number, 3u);
  EXPECT_TRUE(trailOf(samples, TrailColour::none).empty());
}

}  // namespace
}  // namespace app
