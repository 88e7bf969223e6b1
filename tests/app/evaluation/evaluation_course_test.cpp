#include "app/evaluation/evaluation_course.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "app/evaluation/session_tables.h"
#include "app/study/csv.h"
#include "app/study/study_data.h"

namespace app {
namespace {

const std::string kTemplate = R"(title = "T"
language = "en"
consent = "c.md"
[[prompt]]
id = "why"
say = "Why?"
[[task]]
id = "one"
say = "First"
time_box_s = 10
success = "time > 5 s"
[[task]]
id = "two"
say = "Second"
time_box_s = 10
at_time_box = "failed"
success = "time > 5 s"
[[questionnaire]]
use = "debrief-5"
[[questionnaire]]
use = "sus"
)";

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class EvaluationCourseTest : public testing::Test {
 protected:
  EvaluationCourseTest()
      : study_(studyTemplateFrom(kTemplate, "t.toml")),
        course_(study_, {"P07", "surgeon", 1, "E2"}, [this](const LogEvent& event) { events_.push_back(event); }) {}

  Moment at(std::int64_t s) const { return {s * kSecond_ns, static_cast<std::uint64_t>(1000 * s)}; }
  std::string say(const std::string& type, std::vector<std::pair<std::string, LogValue>> data, std::int64_t s = 0) {
    const auto refused = course_.take({s * kSecond_ns, static_cast<std::uint64_t>(1000 * s), "evaluator", type, data});
    return refused.value_or("");
  }
  void consentTo(bool quotes = true) {
    course_.prepare({{"disk", CheckLight::green, ""}}, at(0));
    course_.enter(Phase::consent, at(0));
    for (const std::string_view stream : kConsentStreams)
      EXPECT_EQ(say("consent", {{"stream", std::string(stream)}, {"given", stream != "quotes" || quotes}}), "");
  }
  const LogEvent* last(const std::string& type) const {
    const auto found =
        std::find_if(events_.rbegin(), events_.rend(), [&](const LogEvent& e) { return e.type == type; });
    return found == events_.rend() ? nullptr : &*found;
  }

  StudyTemplate study_;
  std::vector<LogEvent> events_;
  EvaluationCourse course_;
};

TEST_F(EvaluationCourseTest, ARedCheckIsNoStart) {
  EXPECT_FALSE(course_.prepare({{"case", CheckLight::amber, ""}, {"disk", CheckLight::red, "full"}}, at(0)));
  EXPECT_EQ(course_.phase(), Phase::ended);
  course_.enter(Phase::consent, at(1));
  EXPECT_EQ(course_.phase(), Phase::ended);
}

TEST_F(EvaluationCourseTest, EveryStreamIsAllowedOrRefusedByItselfAndTheNewestWordRules) {
  for (int subset = 0; subset < 32; ++subset) {
    EvaluationCourse course(study_, {"P07", "", 1, ""}, [](const LogEvent&) {});
    course.prepare({}, at(0));
    course.enter(Phase::consent, at(0));
    for (std::size_t n = 0; n < kConsentStreams.size(); ++n) {
      EXPECT_FALSE(course.isConsentComplete());
      course.take({0,
                   {},
                   "participant",
                   "consent",
                   {{"stream", std::string(kConsentStreams[n])}, {"given", (subset >> n & 1) != 0}}});
    }
    EXPECT_TRUE(course.isConsentComplete());
    for (std::size_t n = 0; n < kConsentStreams.size(); ++n)
      EXPECT_EQ(course.allows(kConsentStreams[n]), (subset >> n & 1) != 0);
    course.take({0, {}, "participant", "consent", {{"stream", std::string("reuse")}, {"given", false}}});
    EXPECT_FALSE(course.allows("reuse"));
  }
}

TEST_F(EvaluationCourseTest, NoWordOfWhoMayNotBeQuotedIsKept) {
  consentTo(false);
  course_.enter(Phase::tasks, at(1));
  course_.startTask(at(1));
  EXPECT_EQ(say("note", {{"kind", std::string("comment")}, {"text", std::string("canary")}}), "");
  EXPECT_EQ(say("note", {{"kind", std::string("behaviour")}, {"text", std::string("looks up")}}), "");
  course_.enter(Phase::debrief, at(9));
  EXPECT_EQ(
      say("answer",
          {{"questionnaire", std::string("debrief-5")}, {"item", std::string("D1")}, {"words", std::string("canary")}}),
      "");
  for (const LogEvent& event : events_)
    for (const auto& [key, value] : event.data)
      if (const auto* text = std::get_if<std::string>(&value)) {
        EXPECT_NE(*text, "canary") << event.type;
      }
  EXPECT_EQ(*last("note")->text("text"), "looks up");
}

TEST_F(EvaluationCourseTest, RulesEndTasksAndAPersonsDecisionStandsBesideTheirs) {
  consentTo();
  course_.enter(Phase::tasks, at(10));
  EXPECT_NE(say("task", {{"result", std::string("success")}, {"reason", std::string("done")}}), "");
  ASSERT_EQ(course_.startTask(at(10))->id, "one");
  EXPECT_EQ(course_.startTask(at(11)), nullptr);
  EXPECT_NE(say("help", {{"reason", std::string("")}}), "");
  EXPECT_EQ(say("help", {{"reason", std::string("told where")}}, 12), "");
  EXPECT_NE(say("task", {{"result", std::string("partly")}}, 12), "");
  course_.fired({RuleVerdict::success, 15000, 15000, 5.0}, at(15));
  EXPECT_EQ(course_.running(), nullptr);
  EXPECT_EQ(say("task", {{"result", std::string("failed")}, {"reason", std::string("by chance")}}, 16), "");
  const TaskOutcome& outcome = course_.outcomes()[0];
  EXPECT_EQ(outcome.result, TaskResult::failed);
  EXPECT_EQ(outcome.by, "evaluator");
  EXPECT_EQ(outcome.helps, 1);
  EXPECT_EQ(outcome.rule.value().verdict, RuleVerdict::success);
  EXPECT_FALSE(course_.areTasksDone());

  // The second one's time is over: this template lets that decide.
  ASSERT_EQ(course_.startTask(at(20))->id, "two");
  course_.fired({RuleVerdict::time_box, 30000, 30000, 10.0}, at(30));
  EXPECT_EQ(course_.outcomes()[1].result, TaskResult::failed);
  EXPECT_TRUE(course_.areTasksDone());
}

TEST_F(EvaluationCourseTest, TheTimeBoxAsksAndNeverCutsOff) {
  consentTo();
  course_.enter(Phase::tasks, at(0));
  course_.startTask(at(0));
  course_.fired({RuleVerdict::time_box, 10000, 10000, 10.0}, at(10));
  EXPECT_TRUE(course_.isTimeBoxOver());
  ASSERT_NE(course_.running(), nullptr);
  course_.endOfRehearsal(at(12));
  EXPECT_EQ(course_.outcomes()[0].by, "end");
  EXPECT_EQ(last("task.stop")->number("time_s"), 12.0);
}

TEST_F(EvaluationCourseTest, AnswersAreStoredAsGivenAndLockedBySubmit) {
  consentTo();
  const auto answer = [&](LogValue value) {
    return say("answer", {{"questionnaire", std::string("sus")}, {"item", std::string("S1")}, {"value", value}});
  };
  EXPECT_NE(answer(std::int64_t{3}), "");
  course_.enter(Phase::questionnaires, at(5));
  EXPECT_EQ(answer(std::int64_t{3}), "");
  EXPECT_NE(answer(std::int64_t{6}), "");
  EXPECT_NE(answer(2.5), "");
  EXPECT_EQ(answer(std::int64_t{4}), "");
  EXPECT_EQ(say("submit", {{"questionnaire", std::string("sus")}}), "");
  EXPECT_NE(answer(std::int64_t{2}), "");
  EXPECT_NE(say("submit", {{"questionnaire", std::string("sus")}}), "");
}

TEST(WeightedLoadIndex, AComparisonIsAnsweredByOneOrTwo) {
  std::string text = kTemplate;
  text.replace(text.find("use = \"sus\""), 11, "use = \"tlx-weighted\"");
  const StudyTemplate study = studyTemplateFrom(text, "t.toml");
  std::vector<LogEvent> events;
  EvaluationCourse course(study, {"P07", "surgeon", 1, "E2"}, [&](const LogEvent& event) { events.push_back(event); });
  course.prepare({}, {});
  course.enter(Phase::questionnaires, {});
  const auto answer = [&](const char* item, std::int64_t value) {
    return course
        .take({0,
               {},
               "participant",
               "answer",
               {{"questionnaire", std::string("tlx-weighted")}, {"item", std::string(item)}, {"value", value}}})
        .value_or("");
  };
  EXPECT_EQ(answer("effort", 85), "");
  EXPECT_EQ(answer("mental-effort", 2), "");
  EXPECT_EQ(answer("mental-effort", 3), "value: give a whole number from 1 to 2, or leave it out");
  EXPECT_NE(answer("mental-effort", 0), "");
  EXPECT_NE(answer("effort-mental", 1), "") << "each pair once, in the order of the scales";
  const auto tables = sessionTables(study, events, "P07-1");
  const auto sheets = answersFrom(csvTableFrom(tables.back().text, "A"), questionnaireNamed("tlx-weighted"));
  EXPECT_EQ(sheets.at(0).values.at(9), 2.0);
}

TEST_F(EvaluationCourseTest, ItsTablesAreThoseThatAStudyReads) {
  consentTo();
  course_.enter(Phase::tasks, at(100));
  course_.startTask(at(100));
  say("problem",
      {{"problem", std::string("depth")}, {"title", std::string("=cannot, \"see\"")}, {"severity", std::int64_t{3}}},
      103);
  course_.fired({RuleVerdict::success, 105000, 105000, 5.0}, at(105));
  course_.startTask(at(106));
  course_.enter(Phase::questionnaires, at(110));
  say("answer", {{"questionnaire", std::string("sus")}, {"item", std::string("S2")}, {"value", std::int64_t{2}}});
  const auto tables = sessionTables(study_, events_, "P07-1");
  ASSERT_EQ(tables.size(), 3u);
  const auto runs = tasksFrom(csvTableFrom(tables[0].text, tables[0].name));
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].task, "one");
  EXPECT_EQ(runs[0].result, TaskResult::success);
  EXPECT_EQ(runs[0].time_s, 5.0);
  EXPECT_EQ(runs[1].result, TaskResult::failed);
  const auto problems = problemsFrom(csvTableFrom(tables[1].text, tables[1].name));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].task, "one");
  EXPECT_EQ(problems[0].moment, "P07-1 0:03");
  EXPECT_EQ(problems[0].rater, "E2");
  EXPECT_EQ(problems[0].severity, 3);
  EXPECT_EQ(tables[2].name, "answers-sus.csv");
  const auto answers = answersFrom(csvTableFrom(tables[2].text, tables[2].name), questionnaireNamed("sus"));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].values[1], 2.0);
  EXPECT_EQ(answers[0].values[0], std::nullopt);
  EXPECT_EQ(answers[0].group, "surgeon");
}

}  // namespace
}  // namespace app
