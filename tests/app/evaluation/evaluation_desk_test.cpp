#include "app/evaluation/evaluation_desk.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr double kDeskDt_s = 0.001;
constexpr std::int64_t kTick_ns = 1'000'000, kLogBegun_ns = 7'000'000'000;

const std::string kDeskTemplate = R"(title = "T"
language = "en"
consent = "c.md"
[may_change]
law = false
layers = true
[[task]]
id = "one"
say = "First"
tool = "round:2.0"
time_box_s = 60
success = "time > 0.0495 s"
[[task]]
id = "two"
say = "Second"
tool = "round:3.0"
time_box_s = 60
success = "O1.removed >= 1 mm3"
)";

/// Says what it is given.
class SpokenFor : public SessionPeople {
 public:
  std::vector<Said> take(std::string_view, double since_s) override {
    since_s_ = since_s;
    std::vector<Said> all;
    for (LogEvent& event : std::exchange(said_, {}))
      all.push_back({std::move(event), "", [this](const auto& refused) { refused_.push_back(refused.value_or("")); }});
    return all;
  }
  bool leads() const override { return leads_; }
  bool mayEndTasks() const override { return may_end_; }
  void ask(Phase) override {}

  bool leads_ = true, may_end_ = true;
  double since_s_ = 0.0;
  std::vector<LogEvent> said_;
  std::vector<std::string> refused_;
};

class EvaluationDeskTest : public testing::Test {
 protected:
  explicit EvaluationDeskTest(const std::string& study_template = kDeskTemplate)
      : study_(studyTemplateFrom(study_template, "t.toml")),
        course_(study_, {"P07", "", 1, "E1"}, [this](const LogEvent& event) { events_.push_back(event); }) {
    course_.prepare({}, {});
    course_.enter(Phase::consent, {});
    for (const std::string_view stream : kConsentStreams)
      course_.take({0, {}, "", "consent", {{"stream", std::string(stream)}, {"given", stream != "picture"}}});
    course_.enter(Phase::tasks, {});
    events_.clear();
  }

  /// Ticks up to this one, in frames of 16; each removes 0.1 mm3.
  void goTo(EvaluationDesk& desk, std::uint64_t end) {
    while (next_ < end) {
      std::vector<haptics::Tick> ticks;
      for (int n = 0; n < 16 && next_ < end; ++n, ++next_) {
        haptics::Tick& tick = ticks.emplace_back();
        tick.index = next_;
        tick.t_s = kDeskDt_s * static_cast<double>(next_), tick.dt_s = kDeskDt_s;
        tick.removed_mm3 = 0.1;
      }
      clock_ns_ = kLogBegun_ns + kTick_ns * static_cast<std::int64_t>(next_);
      desk.follow(ticks, {}, 0);
    }
  }
  const LogEvent& only(const std::string& type, std::size_t place = 0) const {
    for (const LogEvent& event : events_)
      if (event.type == type && place-- == 0) return event;
    ADD_FAILURE() << "no " << type;
    return events_.front();
  }

  StudyTemplate study_;
  std::vector<LogEvent> events_;
  EvaluationCourse course_;
  SpokenFor people_;
  assets::RiskStructures none_;
  std::uint64_t next_ = 0;
  std::int64_t clock_ns_ = 0;
};

TEST_F(EvaluationDeskTest, AScriptedSessionFiresAndBeginsTheNextAtTheVeryTick) {
  EvaluationDesk desk({study_, course_, people_, {}, kLogBegun_ns});
  desk.open(none_, "");
  goTo(desk, 200);
  EXPECT_EQ(only("task.start").tick, 0u);
  EXPECT_EQ(only("rule").tick, 49u);
  EXPECT_EQ(only("rule").t_ns, kLogBegun_ns + 50 * kTick_ns);
  EXPECT_EQ(only("task.start", 1).tick, 50u);
  // Ten ticks of 0.1 mm3, the rounding of their sum aside.
  EXPECT_NEAR(static_cast<double>(only("rule", 1).tick.value()), 59.5, 0.6);
  EXPECT_TRUE(desk.isOver());
  const std::vector<ControlRequest> tools = desk.takeRequests();
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[1], (ControlRequest{Control::tool, 1}));
  const std::vector<std::string> marks = desk.takeMarks();
  EXPECT_NE(std::ranges::find(marks, "task.stop one success"), marks.end());
}

TEST_F(EvaluationDeskTest, ByHandATaskWaitsAndANoteIsOfItsFirstLetter) {
  people_.leads_ = false;
  EvaluationDesk desk({study_, course_, people_, [&] { return clock_ns_; }, 0});
  desk.open(none_, "");
  goTo(desk, 160);
  EXPECT_TRUE(events_.empty());
  people_.said_.push_back({0, {}, "evaluator", "task", {{"result", std::string("next")}}});
  goTo(desk, 176);
  EXPECT_EQ(only("task.start").tick, 176u);
  goTo(desk, 216);
  people_.said_.push_back({clock_ns_ - 30 * kTick_ns, {}, "evaluator", "note", {{"kind", std::string("behaviour")}}});
  goTo(desk, 217);
  EXPECT_NEAR(static_cast<double>(only("note").tick.value()), 216.0 - 31.0, 1.0);
  goTo(desk, 300);
  EXPECT_EQ(only("rule").tick, 176u + 49u);
  EXPECT_EQ(course_.running(), nullptr);
  EXPECT_FALSE(desk.isOver());
}

TEST_F(EvaluationDeskTest, InAPauseTheTasksClockAndRulesStandStill) {
  people_.leads_ = false;
  EvaluationDesk desk({study_, course_, people_, [&] { return clock_ns_; }, 0});
  desk.open(none_, "");
  const LogEvent next{0, {}, "evaluator", "task", {{"result", std::string("next")}}};
  const LogEvent pause{0, {}, "evaluator", "task", {{"result", std::string("pause")}}};
  people_.said_.push_back(pause);
  goTo(desk, 10);
  ASSERT_EQ(people_.refused_, std::vector<std::string>{"no task goes on"});
  people_.said_.push_back(next);
  goTo(desk, 20);
  // Ticks 20 to 39 are of the task; then it stands until tick 99, far beyond its 50 ticks.
  people_.said_.push_back(pause);
  goTo(desk, 36);
  EXPECT_TRUE(course_.isPaused());
  goTo(desk, 100);
  EXPECT_TRUE(events_.back().type == "task.pause") << events_.back().type;
  EXPECT_NEAR(desk.task_s(), 0.016, 1e-9);
  people_.said_.push_back(pause);
  goTo(desk, 116);
  EXPECT_FALSE(course_.isPaused());
  EXPECT_EQ(only("task.pause").tick, 35u);
  EXPECT_EQ(only("task.resume").tick, 116u);
  EXPECT_NEAR(*only("task.resume").number("paused_s"), 0.080, 1e-9);
  goTo(desk, 200);
  // The fiftieth tick of the task: 16 before the pause and 34 after it.
  EXPECT_EQ(only("rule").tick, 116u + 33u);
  EXPECT_NEAR(*only("task.stop").number("time_s"), 0.050, 1e-9);
}

TEST_F(EvaluationDeskTest, WhoDecidesInAPauseEndsIt) {
  people_.leads_ = false;
  EvaluationDesk desk({study_, course_, people_, [&] { return clock_ns_; }, 0});
  desk.open(none_, "");
  people_.said_.push_back({0, {}, "evaluator", "task", {{"result", std::string("next")}}});
  goTo(desk, 16);
  people_.said_.push_back({0, {}, "evaluator", "task", {{"result", std::string("pause")}}});
  goTo(desk, 32);
  goTo(desk, 64);
  people_.said_.push_back(
      {0, {}, "evaluator", "task", {{"result", std::string("partly")}, {"reason", std::string("he is tired")}}});
  goTo(desk, 80);
  EXPECT_FALSE(course_.isPaused());
  EXPECT_NEAR(*only("task.stop").number("time_s"), 0.016, 1e-9);
}

TEST_F(EvaluationDeskTest, TasksEndWhenTheEvaluatorGoesOn) {
  people_.may_end_ = false;
  EvaluationDesk desk({study_, course_, people_, {}, kLogBegun_ns});
  desk.open(none_, "");
  goTo(desk, 200);
  EXPECT_TRUE(course_.areTasksDone());
  EXPECT_FALSE(desk.isOver());
  people_.may_end_ = true;
  EXPECT_TRUE(desk.isOver());
}

TEST_F(EvaluationDeskTest, WhatMayNotChangeIsRefusedAndBothAreLogged) {
  EvaluationDesk desk({study_, course_, people_, {}, 0});
  desk.open(none_, "");
  EXPECT_FALSE(desk.allows({Control::law, 1}));
  EXPECT_TRUE(desk.allows({Control::layer, 0}));
  EXPECT_FALSE(desk.allows({Control::snapshot}));
  EXPECT_FALSE(desk.allowsPictures());
  EXPECT_TRUE(desk.allows({Control::irrigation}));
  ASSERT_EQ(events_.size(), 3u);
  EXPECT_EQ(*only("change.refused").text("what"), "law");
  EXPECT_EQ(*only("change").text("what"), "layer");
}

TEST_F(EvaluationDeskTest, AWithdrawnLogEndsTheTasks) {
  EvaluationDesk desk({study_, course_, people_, {}, 0});
  desk.open(none_, "");
  goTo(desk, 20);
  EXPECT_FALSE(desk.isOver());
  course_.take({1, {}, "", "consent", {{"stream", std::string("log")}, {"given", false}}});
  EXPECT_TRUE(desk.isOver());
  desk.finish();
  EXPECT_EQ(*only("task.stop").text("by"), "end");
}

/// Half of the plan is gone from tick 100 on; told some ticks later.
class LateBone : public BoneSource {
 public:
  void start(const std::string& recording) override { recording_ = recording; }
  void update(std::uint64_t newest, std::chrono::milliseconds most_wait) override {
    if (is_lost_) return;
    const std::uint64_t made = newest + 1;
    followed_ = std::max(followed_, most_wait > most_wait.zero() ? made : made - std::min(made, kBehind));
  }
  std::uint64_t followed() const override { return followed_; }
  std::optional<double> value(std::string_view id, std::uint64_t tick) override {
    EXPECT_LT(tick, followed_);
    return id == "O2.plan" ? std::optional(tick < kHalf ? 0.25 : 0.5) : std::nullopt;
  }
  bool isLost() const override { return is_lost_; }
  std::vector<News> takeNews() override { return {}; }

  static constexpr std::uint64_t kHalf = 100, kBehind = 40;
  std::string recording_;
  std::uint64_t followed_ = 0;
  bool is_lost_ = false;
};

const std::string kBoneTemplate = R"(title = "T"
language = "en"
consent = "c.md"
[[task]]
id = "one"
say = "First"
time_box_s = 60
success = "O2.plan >= 0.5"
hold_s = 0.01
[[task]]
id = "two"
say = "Second"
time_box_s = 60
success = "time > 0.05 s"
)";

class BoneDeskTest : public EvaluationDeskTest {
 protected:
  BoneDeskTest() : EvaluationDeskTest(kBoneTemplate) {}
  EvaluationDesk::Parts parts(bool is_live = true) {
    return {study_,       course_,
            people_,      is_live ? std::function<std::int64_t()>([&] { return clock_ns_; }) : nullptr,
            kLogBegun_ns, &bone_};
  }
  LateBone bone_;
};

TEST_F(BoneDeskTest, ARuleFiresWithItsTickThoughTheBoneIsToldLater) {
  EvaluationDesk desk(parts());
  desk.open(none_, "s.molar");
  EXPECT_EQ(bone_.recording_, "s.molar");
  goTo(desk, 144);
  EXPECT_EQ(std::ranges::count(events_, "rule", &LogEvent::type), 0);
  goTo(desk, 200);
  EXPECT_EQ(only("rule").number("rule_tick"), 100.0);
  EXPECT_EQ(only("rule").tick, 110u);
  EXPECT_GE(only("task.stop").tick, 144u);
  EXPECT_EQ(only("rules.looked").number("until"), 110.0);
  EXPECT_EQ(only("task.start", 1).tick, *only("task.stop").tick + 1);
}

TEST_F(BoneDeskTest, WhereTicksAreTheClockItIsWaitedForAndTheNextBeginsAtTheVeryTick) {
  EvaluationDesk desk(parts(false));
  desk.open(none_, "s.molar");
  goTo(desk, 200);
  EXPECT_EQ(only("rule").tick, 110u);
  EXPECT_EQ(only("task.stop").tick, 110u);
  EXPECT_EQ(only("task.start", 1).tick, 111u);
}

TEST_F(BoneDeskTest, WhoDecidesByHandLeavesUnaskedWhatWasNotToldYet) {
  people_.leads_ = false;
  EvaluationDesk desk(parts());
  desk.open(none_, "s.molar");
  people_.said_.push_back({0, {}, "evaluator", "task", {{"result", std::string("next")}}});
  goTo(desk, 16);
  goTo(desk, 112);
  people_.said_.push_back(
      {0, {}, "evaluator", "task", {{"result", std::string("partly")}, {"reason", std::string("he is tired")}}});
  goTo(desk, 128);
  EXPECT_EQ(std::ranges::count(events_, "rule", &LogEvent::type), 0);
  EXPECT_EQ(only("task.stop").tick, 127u);
  EXPECT_EQ(only("rules.looked").number("until"), 87.0);
}

TEST_F(BoneDeskTest, WithoutWhoTellsTheBoneTheRestOfTheRulesIsLookedAt) {
  EvaluationDesk desk(parts());
  desk.open(none_, "s.molar");
  goTo(desk, 64);
  bone_.is_lost_ = true;
  goTo(desk, 300);
  EXPECT_EQ(std::ranges::count(events_, "rule", &LogEvent::type), 0);
  EXPECT_NE(course_.running(), nullptr);
  desk.finish();
  EXPECT_EQ(only("rules.looked").number("until"), 299.0);
}

}  // namespace
}  // namespace app
