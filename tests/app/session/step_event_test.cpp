#include "app/session/step_event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace app {
namespace {

using testing::ElementsAre;

ProcedureRun someRun() {
  ProcedureRun run{"third-molar", "assessed", {}};
  run.steps = {
      {"flap", "Raise the flap", StepState::given, 0.001, 0.0, {}},
      {"bone", "Bare the crown: gently", StepState::met, 0.001, 41.25, {{"cutting dry", 2}, {"too near the nerve", 1}}},
      {"section", "Section", StepState::skipped, 41.251, 10.0, {}},
      {"close", "Close", StepState::not_reached, {}, 0.0, {}}};
  return run;
}

std::vector<std::string> eventsOf(const ProcedureRun& run) {
  std::vector<std::string> events{procedureText(run)};
  for (const StepRecord& step : run.steps) {
    if (step.begin_s) events.push_back(stepBeginText(step));
    for (const auto& [error, times] : step.errors)
      for (int n = 0; n < times; ++n) events.push_back(stepErrorText(step, error, 3.25));
    events.push_back(stepEndText(step));
  }
  return events;
}

TEST(StepEvent, ReadsBackWhatWasWritten) {
  const ProcedureRun run = someRun();
  std::optional<ProcedureRun> read;
  for (const std::string& event : eventsOf(run)) addStepEvent(read, event);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "third-molar");
  EXPECT_EQ(read->guidance, "assessed");
  ASSERT_EQ(read->steps.size(), run.steps.size());
  for (std::size_t n = 0; n < run.steps.size(); ++n) {
    EXPECT_EQ(read->steps[n].key, run.steps[n].key);
    EXPECT_EQ(read->steps[n].title, run.steps[n].title);
    EXPECT_EQ(read->steps[n].state, run.steps[n].state);
    EXPECT_EQ(read->steps[n].begin_s, run.steps[n].begin_s);
    EXPECT_EQ(read->steps[n].duration_s, run.steps[n].duration_s);
    EXPECT_EQ(read->steps[n].errors, run.steps[n].errors);
  }
}

TEST(StepEvent, AKilledSessionKeepsTheStepThatWasOpen) {
  const std::vector<std::string> events = eventsOf(someRun());
  std::optional<ProcedureRun> read;
  for (std::size_t n = 0; n < 4; ++n) addStepEvent(read, events[n]);
  ASSERT_EQ(read->steps.size(), 2u);
  EXPECT_EQ(read->steps[1].state, StepState::open);
  EXPECT_FALSE(read->isComplete());
}

TEST(StepEvent, OtherWordsChangeNothing) {
  std::optional<ProcedureRun> read;
  for (const char* const text : {"", "begin bone at 1 s: Bone", "procedure", "procedure x", "end"})
    addStepEvent(read, text);
  EXPECT_FALSE(read);
  addStepEvent(read, "procedure own, free, 2 steps");
  for (const char* const text :
       {"begin bone", "begin bone at x s: Bone", "error in bone at 1: dry", "end bone", "end bone: lost"})
    addStepEvent(read, text);
  EXPECT_TRUE(read->steps.empty());
}

TEST(StepEvent, SaysItInASurgeonsWords) {
  const ProcedureRun run = someRun();
  EXPECT_THAT(stepsInWords(run),
              ElementsAre("1 Raise the flap: given",
                          "2 Bare the crown: gently: met after 0:41; cutting dry 2 times; too near the nerve once",
                          "3 Section: skipped after 0:10", "4 Close: not reached"));
  EXPECT_EQ(procedureInWords(run),
            "third-molar, assessed: 1 met, 1 given, 1 skipped, 1 not reached of 4 steps; 3 errors");
  EXPECT_FALSE(run.end_s());
}

TEST(StepEvent, APredictionIsReadBackAndComparedWithTheTimeUsed) {
  Prediction p{"moderate", 12.0, 3.5, "difficult", 8.0};
  const auto read = predictionFrom(predictionText(p));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->difficulty, "moderate");
  EXPECT_EQ(read->minutes, 12.0);
  EXPECT_EQ(read->at_s, 3.5);
  EXPECT_EQ(read->computed, "difficult");
  EXPECT_EQ(read->index, 8.0);
  EXPECT_EQ(predictionInWords(p, 573.5), "moderate, 12 min; computed: difficult (8 of 10); used: 9.5 min");
  p = {"", 5.0, 0.0, "", {}};
  EXPECT_EQ(predictionInWords(*predictionFrom(predictionText(p)), 60.0), "5 min; computed: not known; used: 1.0 min");
  EXPECT_EQ(predictionInWords({}, 60.0), "");
  EXPECT_FALSE(predictionFrom("moderate"));
}

}  // namespace
}  // namespace app
