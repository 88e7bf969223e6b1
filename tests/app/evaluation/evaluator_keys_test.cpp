#include "app/evaluation/evaluator_keys.h"

#include <gtest/gtest.h>

namespace app {
namespace {

/// A key each 10 ns from 100 on.
std::vector<LogEvent> typed(EvaluatorKeys& keys, const std::string& bytes) {
  std::vector<LogEvent> said;
  std::int64_t t_ns = 90;
  for (const char c : bytes)
    if (auto event = keys.take(c, t_ns += 10)) said.push_back(*event);
  return said;
}

TEST(EvaluatorKeys, ANoteHasTheTimeOfItsFirstLetter) {
  EvaluatorKeys keys({});
  const auto said = typed(keys, "1looks\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].type, "note");
  EXPECT_EQ(said[0].t_ns, 110);
  EXPECT_EQ(*said[0].text("kind"), "behaviour");
  EXPECT_EQ(*said[0].text("text"), "looks");
  EXPECT_EQ(said[0].number("severity"), std::nullopt);
}

TEST(EvaluatorKeys, DigitsAreTextWhileALineIsOpen) {
  EvaluatorKeys keys({});
  const auto said = typed(keys, "2I see 4 of 5\t\t\n4");
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(*said[0].text("text"), "I see 4 of 5");
  EXPECT_EQ(said[0].number("severity"), 1.0);
  EXPECT_EQ(said[1].type, "bookmark");
}

TEST(EvaluatorKeys, EscapeDropsAndBackspaceTakesAWholeLetter) {
  EvaluatorKeys keys({});
  EXPECT_TRUE(typed(keys, "1looks\x1b").empty());
  EXPECT_EQ(keys.line(), "");
  EXPECT_EQ(*typed(keys, "1h\xc3\xb6\x7f\x7f\x7fja\n").at(0).text("text"), "ja");
  EXPECT_TRUE(typed(keys, "1\n").empty());
}

TEST(EvaluatorKeys, TasksAreDecidedWithAReasonOrGoOn) {
  EvaluatorKeys keys({"why", "expect"});
  EXPECT_EQ(*typed(keys, "55").at(0).text("result"), "next");
  const auto said = typed(keys, "52stopped early\n3+3");
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].type, "task");
  EXPECT_EQ(*said[0].text("result"), "partly");
  EXPECT_EQ(*said[0].text("reason"), "stopped early");
  EXPECT_EQ(*said[1].text("prompt"), "why");
  EXPECT_EQ(*said[2].text("prompt"), "expect");
}

TEST(EvaluatorKeys, HelpProblemAndWithdrawal) {
  EvaluatorKeys keys({});
  EXPECT_EQ(*typed(keys, "6told where\n").at(0).text("reason"), "told where");
  const LogEvent problem = typed(keys, "7depth: it cannot be seen\n").at(0);
  EXPECT_EQ(*problem.text("problem"), "depth");
  EXPECT_EQ(*problem.text("title"), "it cannot be seen");
  const LogEvent withdrawn = typed(keys, "8quotes\n").at(0);
  EXPECT_EQ(withdrawn.type, "consent");
  EXPECT_EQ(withdrawn.flag("given"), false);
}

}  // namespace
}  // namespace app
