#include "app/review/reference_set.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "app/session/gates.h"
#include "app/text/usage_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// A run with a clean outcome, its painting index and time.
SessionMetrics runOf(double painting, double time_s) {
  SessionMetrics run;
  run.patient_title = "built-in patient";
  run.program_version = "0.1.0";
  run.measures = {{"PI", "painting index", "", painting, {}, {}},
                  {"M1.total", "length of the work", "s", time_s, {}, {}},
                  {"M9.changes", "changes of bur", "", 2.0, {}, {}},
                  {"O5.area", "area of these perforations", "mm2", 0.0, {}, {}},
                  {"S6.force", "share of contact with more force", "", {}, "it needs a reference set", {}}};
  run.touched.emplace();
  run.socket.emplace();
  return run;
}

const std::vector<SessionMetrics> kExperts{runOf(0.8, 300.0), runOf(0.9, 320.0), runOf(0.7, 280.0)};

const Score& scoreOf(const std::vector<Score>& scores, std::string_view id) {
  return *std::ranges::find(scores, id, &Score::id);
}

TEST(ReferenceSet, ScoresInStandardDeviationsWithMedianAndRange) {
  const ReferenceSet set = referenceOf("expert", kExperts);
  const auto scores = scoresOf(runOf(0.6, 340.0), set);
  const Score& painting = scoreOf(scores, "PI");
  EXPECT_NEAR(painting.z.value(), -2.0, 1e-9) << "mean 0.8, deviation 0.1";
  EXPECT_EQ(painting.better, 1);
  EXPECT_EQ(painting.median, 0.8);
  EXPECT_EQ(painting.low, 0.7);
  EXPECT_EQ(painting.high, 0.9);
  EXPECT_NEAR(scoreOf(scores, "M1.total").z.value(), 2.0, 1e-9);
  EXPECT_EQ(scoreOf(scores, "M1.total").better, -1);
  EXPECT_FALSE(scoreOf(scores, "M9.changes").z) << "no spread";
  EXPECT_EQ(std::ranges::find(scores, "S6.force", &Score::id), scores.end());
}

TEST(ReferenceSet, TwoRunsHaveNoZ) {
  const ReferenceSet set = referenceOf("two", std::span(kExperts).first(2));
  EXPECT_FALSE(scoreOf(scoresOf(runOf(0.6, 340.0), set), "PI").z);
  EXPECT_FALSE(gradeOf(kExperts, set).z);
}

TEST(ReferenceSet, IsReadAsWrittenAndHoldsNoPath) {
  SessionMetrics with_force = kExperts[0];
  with_force.envelope.add(1, 2.04, 13.5, 0.25);
  const std::vector<SessionMetrics> runs{with_force, kExperts[1]};
  const ReferenceSet set = referenceOf("expert-1", runs);
  const std::string text = referenceText(set);
  const ReferenceSet again = referenceFromText(text, "x");
  EXPECT_EQ(again.name, "expert-1");
  EXPECT_EQ(again.case_title, set.case_title);
  ASSERT_EQ(again.runs.size(), 2u);
  EXPECT_EQ(again.runs[0].values, set.runs[0].values);
  EXPECT_EQ(again.envelope.force_s, set.envelope.force_s);
  EXPECT_EQ(again.envelope.speed_s, set.envelope.speed_s);
  EXPECT_EQ(text.find(".molar"), std::string::npos);
}

TEST(ReferenceSet, WhatIsNoneIsRefusedInOneLine) {
  const std::string good = referenceText(referenceOf("expert", kExperts));
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string("[1]"), std::string(R"({"molar_reference": 1})"),
        std::string(R"({"molar_reference":1,"name":"../x","case":"","made_utc":"","runs":[]})"),
        std::string(R"({"molar_reference":1,"name":"x","case":"","made_utc":"","runs":[{"values":{"PI":"a"}}]})"),
        good.substr(0, good.size() / 2)}) {
    try {
      referenceFromText(text, "here");
      FAIL() << text;
    } catch (const UsageError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("here: ")) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  for (const char* name : {"", "../up", "a b", "ä"}) EXPECT_THROW(referenceFile(name), UsageError) << name;
  SessionMetrics other = kExperts[0];
  other.patient_title = "another case";
  EXPECT_THROW(scoresOf(other, referenceOf("expert", kExperts)), UsageError);
  const std::vector<SessionMetrics> mixed{kExperts[0], other};
  EXPECT_THROW(referenceOf("mixed", mixed), UsageError);
}

TEST(ReferenceSet, ExpertsAgainstThemselvesAreATwentiethAboveTheirForce) {
  std::vector<SessionMetrics> runs(3, kExperts[0]);
  for (SessionMetrics& run : runs)
    for (int n = 0; n < 100; ++n) run.envelope.add(0, 0.01 * n, 0.3 * n, 0.001);
  const ReferenceSet set = referenceOf("expert", runs);
  tellAgainst(runs[0], set);
  EXPECT_NEAR(valueOf(runs[0], "S6.force").value(), 0.05, 0.01);
}

TEST(Grade, NeedsThreeRunsAndIsTheirMedian) {
  const ReferenceSet set = referenceOf("expert", kExperts);
  const std::vector<SessionMetrics> few{runOf(0.8, 300.0), runOf(0.8, 300.0)};
  EXPECT_FALSE(gradeOf(few, set).z);
  EXPECT_EQ(gradeOf(few, set).words, "no grade: 2 of 3 runs");
  // z of the graded: painting and time alike.
  const std::vector<SessionMetrics> runs{runOf(0.8, 300.0), runOf(0.65, 330.0), runOf(0.5, 360.0)};
  const Grade grade = gradeOf(runs, set);
  EXPECT_NEAR(grade.z.value(), -1.5, 1e-9);
  EXPECT_NEAR(grade.low.value(), -3.0, 1e-9);
  EXPECT_NEAR(grade.high.value(), 0.0, 1e-9);
  EXPECT_EQ(grade.words, "below the set expert");
  EXPECT_EQ(gradeOf(kExperts, set).words, "as the set expert");
}

TEST(Grade, AnEventIsNeverAveragedAway) {
  const ReferenceSet set = referenceOf("expert", kExperts);
  std::vector<SessionMetrics> runs = kExperts;
  runs[1].touched->push_back({"mandibular canal", 1, 0.1});
  EXPECT_EQ(gradeOf(runs, set).words, "no grade: mandibular canal touched or laid open");
  EXPECT_TRUE(gradeOf(runs, set).z) << "the numbers are told";
}

TEST(Gates, AreOpenClosedOrNotKnown) {
  SessionMetrics run = runOf(0.8, 300.0);
  for (const Gate& gate : gatesOf(run)) EXPECT_EQ(gate.is_open, false) << gate.name;
  run.socket->retained = {{3.0, {}}};
  run.socket->canal.amount = 2.5;
  run.measures.push_back({"O10.second_molar", "removed of the second molar", "mm3", 0.5, {}, 12.0});
  run.measures[3].value = 4.0;
  for (const Gate& gate : gatesOf(run)) EXPECT_EQ(gate.is_open, true) << gate.name;
  EXPECT_NE(gatesInWords(run).find("0.50 mm³ gone at 0:12"), std::string::npos) << gatesInWords(run);
  run.measures.back().value = 0.002;
  EXPECT_NE(gatesInWords(run).find("less than 0.01 mm³ gone"), std::string::npos) << gatesInWords(run);
  // What nobody can spare who takes the tooth out is told, but is no event.
  run.socket->canal_by_root_mm2 = 2.5;
  EXPECT_EQ(gatesOf(run)[2].is_open, false);
  EXPECT_NE(gatesInWords(run).find("laid open: no, 2.5 mm² bare where the tooth lay on it"), std::string::npos);
  run.socket->canal.amount = 3.5;
  EXPECT_EQ(gatesOf(run)[2].is_open, true);
  EXPECT_NE(gatesInWords(run).find("1.0 mm² laid open through bone, 2.5 mm² bare"), std::string::npos);
  for (const Gate& gate : gatesOf(SessionMetrics())) {
    EXPECT_FALSE(gate.is_open) << gate.name;
    EXPECT_FALSE(gate.words.empty()) << gate.name;
  }
}

TEST(Scores, EventsComeFirstAndConditionsLast) {
  const ReferenceSet set = referenceOf("expert", kExperts);
  SessionMetrics run = runOf(0.75, 310.0);
  haptics::Command command;
  run.conditions.follow(command);
  run.conditions.stereo = true;
  run.conditions.missed_ticks = 3;
  const std::string words = scoresText(run, set);
  const std::size_t event = words.find("lingual plate"), score = words.find("painting index"),
                    condition = words.find("conditions: 0.1.0; law agus");
  ASSERT_NE(condition, std::string::npos) << words;
  EXPECT_LT(event, score);
  EXPECT_LT(score, condition);
  for (const char* part :
       {"stereo on", "3 ticks missed", "force 1:1 up to 3.3 N", "calibration", "no grade of one run"})
    EXPECT_NE(words.find(part), std::string::npos) << part << "\n" << words;
}

TEST(Scores, MissedTicksAreReadFromThePunctualityOfTheServo) {
  EXPECT_EQ(missedTicksFrom("1000 ticks, 7 deadlines missed, 1 by its own work; late by 3 µs"), 7u);
  EXPECT_FALSE(missedTicksFrom("no words of it"));
}

}  // namespace
}  // namespace app
