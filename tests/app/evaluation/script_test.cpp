#include "app/evaluation/script.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

StudyTemplate study() {
  return studyTemplateFrom(
      "title = \"T\"\nlanguage = \"en\"\nconsent = \"c.md\"\n[[task]]\nid = \"cut\"\nsay = \"Cut\"\ntime_box_s = 5\n"
      "success = \"time > 1 s\"\n",
      "t.toml");
}

TEST(EvaluationScript, GivesWhatIsDueOnceAndForItsParticipantAlone) {
  EvaluationScript script(
      R"({"during": "cut", "at_s": 2, "type": "note", "data": {"kind": "comment"}}
{"during": "cut", "at_s": 1, "type": "bookmark"}

{"during": "cut", "at_s": 0, "type": "bookmark", "for": ["P02"]}
{"during": "consent", "type": "consent", "src": "participant", "data": {"stream": "log", "given": true}}
)",
      "s.jsonl", study(), "P01");
  EXPECT_TRUE(script.takeDue("cut", 0.5).empty());
  ASSERT_EQ(script.takeDue("cut", 1.0).size(), 1u);
  EXPECT_EQ(script.takeDue("cut", 9.0).at(0).where, "s.jsonl line 1");
  EXPECT_EQ(script.left().size(), 1u);
  EXPECT_EQ(script.takeDue("consent", 0.0).at(0).event.flag("given"), true);
}

TEST(EvaluationScript, RefusesWithFileAndLine) {
  for (const auto& [line, word] : std::vector<std::pair<std::string, std::string>>{
           {"{", "is no JSON object"},
           {"[]", "is no JSON object"},
           {R"({"type": "note"})", "during: give a text"},
           {R"({"during": "rest", "type": "note"})", "during: give a task"},
           {R"({"during": "cut"})", "type: give a text"},
           {R"({"during": "cut", "type": "note", "at": 1})", "at: no such key"},
           {R"({"during": "cut", "type": "note", "at_s": -1})", "at_s: give seconds"},
           {R"({"during": "cut", "type": "note", "at_s": "1"})", "at_s: give seconds"},
           {R"({"during": "cut", "type": "note", "src": "nurse"})", "src: give evaluator"},
           {R"({"during": "cut", "type": "note", "for": "P01"})", "for: give a list"},
           {R"({"during": "cut", "type": "note", "data": []})", "data: give an object"},
           {R"({"during": "cut", "type": "note", "data": {"a": [1]}})", "data.a: give a text"},
           {std::string(200, '['), "nested too deeply"}}) {
    const std::string refusal = tests::refusalOf<UsageError>(
        [&, &text = line] { EvaluationScript script("\n" + text, "s.jsonl", study(), "P01"); });
    EXPECT_NE(refusal.find("s.jsonl line 2"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(word), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace app
