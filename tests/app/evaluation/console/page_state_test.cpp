#include "app/evaluation/console/page_state.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace app {
namespace {

using nlohmann::json;

constexpr std::int64_t kBegan_ns = 1'000'000'000;
const std::string kStateTemplate = R"(title = "T"
language = "en"
consent = "c.md"
[warm_up]
block = "block-plate"
seconds = 60
[[prompt]]
id = "why"
say = "Why?"
[[task]]
id = "one"
say = "First"
time_box_s = 10
success = "O1.removed >= 2 mm3 and not S1.canal < 1 mm"
fail = "S1.canal < 0 mm"
[[questionnaire]]
use = "debrief-5"
[[questionnaire]]
use = "sus"
)";

class PageStateTest : public testing::Test {
 protected:
  PageStateTest()
      : study_(studyTemplateFrom(kStateTemplate, "t.toml")),
        course_(study_, {"P07", "", 2, "E1"}, [this](const LogEvent& event) { state_.add(event); }),
        state_(study_, course_, "What is kept", kBegan_ns) {}
  json now(const PageNow& now = {}) const { return json::parse(state_.text(now)); }
  static Moment at(double s) { return {kBegan_ns + static_cast<std::int64_t>(1e9 * s), 5}; }
  void say(const std::string& type, std::vector<std::pair<std::string, LogValue>> data, double s = 1.0) {
    EXPECT_FALSE(course_.take({at(s).t_ns, 5, "evaluator", type, std::move(data)})) << type;
  }
  void goToTasks(bool quotes) {
    course_.prepare({{"disk", CheckLight::amber, "9 GB"}}, at(0));
    course_.enter(Phase::consent, at(0));
    for (const std::string_view stream : kConsentStreams)
      say("consent", {{"stream", std::string(stream)}, {"given", stream != "quotes" || quotes}});
    course_.enter(Phase::tasks, at(2));
    course_.startTask(at(2));
  }

  StudyTemplate study_;
  EvaluationCourse course_;
  PageState state_;
};

TEST_F(PageStateTest, TellsChecksAndStreamsAsTheyStand) {
  course_.prepare({{"disk", CheckLight::amber, "9 GB"}}, at(0));
  course_.enter(Phase::consent, at(0));
  say("consent", {{"stream", std::string("log")}, {"given", true}});
  say("consent", {{"stream", std::string("audio")}, {"given", false}});
  const json state = now();
  EXPECT_EQ(state["phase"], "consent");
  EXPECT_EQ(state["visit"], 2);
  EXPECT_EQ(state["checks"], json::parse(R"([{"name":"disk","light":"amber","words":"9 GB"}])"));
  EXPECT_EQ(state["consent"]["text"], "What is kept");
  EXPECT_EQ(state["consent"]["streams"][0]["given"], true);
  EXPECT_EQ(state["consent"]["streams"][1]["given"], false);
  EXPECT_TRUE(state["consent"]["streams"][2]["given"].is_null());
  EXPECT_EQ(state["phases"].size(), 7u);
  EXPECT_TRUE(state["task"].is_null());
}

TEST_F(PageStateTest, RulesStandWithTheirValuesAndNotIsTurnedRound) {
  goToTasks(true);
  PageNow with;
  with.task_s = 3.26;
  with.measure = [](std::string_view id) { return id == "O1.removed" ? std::optional(0.6234) : std::nullopt; };
  const json task = now(with)["task"];
  EXPECT_EQ(task["id"], "one");
  EXPECT_EQ(task["elapsed_s"], 3.3);
  EXPECT_EQ(task["success"][0]["text"], "O1.removed >= 2 mm3");
  EXPECT_EQ(task["success"][0]["value"], 0.623);
  EXPECT_EQ(task["success"][0]["holds"], false);
  EXPECT_EQ(task["success"][1]["text"], "S1.canal >= 1 mm");
  EXPECT_TRUE(task["success"][1]["value"].is_null());
  EXPECT_TRUE(task["success"][1]["holds"].is_null());
  EXPECT_EQ(task["fail"][0]["op"], "<");
}

TEST_F(PageStateTest, NotesAndPromptsStandInTheOrderOfTheLog) {
  goToTasks(true);
  say("note", {{"kind", std::string("behaviour")}, {"text", std::string("looks up")}, {"severity", std::int64_t{2}}},
      3.5);
  say("prompt", {{"prompt", std::string("why")}}, 4.0);
  say("task", {{"result", std::string("pause")}}, 5.0);
  const json state = now();
  EXPECT_EQ(state["prompts"][0]["said"], 1);
  EXPECT_EQ(state["task"]["paused"], true);
  const json& notes = state["notes"];
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_EQ(notes[0]["type"], "task.start");
  EXPECT_EQ(notes[1]["text"], "looks up");
  EXPECT_EQ(notes[1]["severity"], 2);
  EXPECT_EQ(notes[1]["at_s"], 3.5);
  EXPECT_EQ(notes[1]["task"], "one");
  EXPECT_EQ(notes[3]["type"], "task.pause");
}

TEST_F(PageStateTest, TheDebriefHasNotesAndIncidentsOnOneBarWithEveryDigitOfItsFigures) {
  goToTasks(true);
  EXPECT_TRUE(now()["debrief"].is_null());
  say("note", {{"kind", std::string("comment")}, {"text", std::string("deep")}});
  EXPECT_FALSE(
      course_.take({at(9.0).t_ns, {}, "evaluator", "bookmark", {{"label", std::string()}, {"moment_s", 2.5}}}));
  // What has no place in the recording is on no bar.
  EXPECT_FALSE(course_.take({at(9.5).t_ns, {}, "evaluator", "note", {{"kind", std::string("behaviour")}}}));
  PageNow with;
  with.debrief.emplace();
  with.debrief->t_s = 1.0 / 3.0, with.debrief->length_s = 7.0, with.debrief->tick_s = 0.1;
  with.debrief->prepared_share = 1.0;
  with.debrief->values = {.tick = 3, .t_s = 0.3, .force_N = 2.0 / 3.0, .removed_mm3 = 1e-17, .bone_digest = 0xabc};
  with.debrief->incidents = {{1.5, "the canal was touched"}};
  const json debrief = now(with)["debrief"];
  EXPECT_EQ(debrief["t_s"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(debrief["force_N"].get<double>(), 2.0 / 3.0);
  EXPECT_EQ(debrief["removed_mm3"].get<double>(), 1e-17);
  EXPECT_EQ(debrief["bone_digest"], "0000000000000abc");
  std::vector<std::string> told;
  for (const json& mark : debrief["marks"])
    told.push_back(mark["type"].get<std::string>() + " " + std::to_string(mark["t_s"].get<double>()).substr(0, 3));
  // Task and note at tick 5.
  EXPECT_EQ(told, (std::vector<std::string>{"task 0.5", "note 0.5", "error 1.5", "bookmark 2.5"}));
  EXPECT_EQ(debrief["marks"][1]["seq"], now()["notes"][1]["seq"]);
}

TEST_F(PageStateTest, WordsThatAreNotKeptAreNotShown) {
  goToTasks(false);
  say("note", {{"kind", std::string("comment")}, {"text", std::string("canary")}});
  course_.enter(Phase::debrief, at(9));
  say("answer",
      {{"questionnaire", std::string("debrief-5")}, {"item", std::string("D1")}, {"words", std::string("canary")}});
  EXPECT_EQ(now().dump().find("canary"), std::string::npos);
  EXPECT_EQ(now()["notes"][1]["kind"], "comment");
}

TEST_F(PageStateTest, WhatIsNotKeptAnyMoreIsTold) {
  EXPECT_FALSE(now().contains("not_kept"));
  PageNow with;
  with.not_kept = "the session is not recorded any more: the disk is full";
  EXPECT_EQ(now(with)["not_kept"], with.not_kept);
}

TEST_F(PageStateTest, EachPhaseAsksItsOwnQuestionnaires) {
  goToTasks(true);
  EXPECT_TRUE(now()["questionnaires"].empty());
  course_.enter(Phase::debrief, at(9));
  ASSERT_EQ(now()["questionnaires"].size(), 1u);
  EXPECT_EQ(now()["questionnaires"][0]["words"], true);
  course_.enter(Phase::questionnaires, at(10));
  say("answer", {{"questionnaire", std::string("sus")}, {"item", std::string("S1")}, {"value", std::int64_t{4}}});
  say("submit", {{"questionnaire", std::string("sus")}});
  const json sus = now()["questionnaires"][0];
  EXPECT_EQ(sus["id"], "sus");
  EXPECT_EQ(sus["items"].size(), 10u);
  EXPECT_EQ(sus["items"][0]["from"], 1);
  EXPECT_EQ(sus["items"][0]["to"], 5);
  EXPECT_EQ(sus["answers"]["S1"], 4);
  EXPECT_EQ(sus["locked"], true);
}

TEST_F(PageStateTest, WhatIsNoTextIsStillAText) {
  goToTasks(true);
  say("note", {{"kind", std::string("behaviour")}, {"text", std::string("\xff\xfe\"<script>\n")}});
  EXPECT_NE(now()["notes"][1]["text"].get<std::string>().find("<script>"), std::string::npos);
}

}  // namespace
}  // namespace app
