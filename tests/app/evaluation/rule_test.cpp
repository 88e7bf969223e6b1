#include "app/evaluation/rule.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/refusal.h"

namespace app {
namespace {

const std::vector<RuleMeasure> kKnown{{"a", "mm"}, {"b", ""}, {"c", "s"}};

/// "true", "false", or "unknown".
std::string heldBy(const std::string& rule, const std::map<std::string, double, std::less<>>& values) {
  const auto holds = Rule::from(rule, kKnown).holds([&](std::string_view id) {
    const auto found = values.find(id);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  });
  return !holds ? "unknown" : *holds ? "true" : "false";
}

TEST(Rule, ComparesWithEachOperator) {
  for (const auto& [rule, below, at, above] :
       std::vector<std::array<std::string, 4>>{{"a < 2 mm", "true", "false", "false"},
                                               {"a <= 2 mm", "true", "true", "false"},
                                               {"a > 2 mm", "false", "false", "true"},
                                               {"a >= 2 mm", "false", "true", "true"},
                                               {"a == 2 mm", "false", "true", "false"}}) {
    EXPECT_EQ(heldBy(rule, {{"a", 1.0}}), below) << rule;
    EXPECT_EQ(heldBy(rule, {{"a", 2.0}}), at) << rule;
    EXPECT_EQ(heldBy(rule, {{"a", 3.0}}), above) << rule;
  }
}

TEST(Rule, AndBindsCloserThanOr) {
  EXPECT_EQ(heldBy("b > 0 or b > 5 and b > 9", {{"b", 1.0}}), "true");
  EXPECT_EQ(heldBy("(b > 0 or b > 5) and b > 9", {{"b", 1.0}}), "false");
  EXPECT_EQ(heldBy("not b > 5 and b > 0", {{"b", 1.0}}), "true");
  EXPECT_EQ(heldBy("not (b > 5 or b < -1.5e-1)", {{"b", 1.0}}), "true");
}

TEST(Rule, IsNotCertainOfWhatIsNotKnown) {
  EXPECT_EQ(heldBy("a > 1 mm", {}), "unknown");
  EXPECT_EQ(heldBy("not a > 1 mm", {}), "unknown");
  EXPECT_EQ(heldBy("a > 1 mm and b > 0", {{"b", -1.0}}), "false");
  EXPECT_EQ(heldBy("a > 1 mm and b > 0", {{"b", 1.0}}), "unknown");
  EXPECT_EQ(heldBy("a > 1 mm or b > 0", {{"b", 1.0}}), "true");
}

TEST(Rule, AgreesWithAllTruthValues) {
  for (int bits = 0; bits < 8; ++bits) {
    const bool a = (bits & 1) != 0, b = (bits & 2) != 0, c = (bits & 4) != 0;
    const std::map<std::string, double, std::less<>> values{{"a", a}, {"b", b}, {"c", c}};
    EXPECT_EQ(heldBy("a == 1 mm and not b == 1 or not (c == 1 s or a == 1 mm)", values),
              (a && !b) || !(c || a) ? "true" : "false")
        << bits;
  }
}

TEST(Rule, NamesItsMeasuresOnce) {
  EXPECT_EQ(Rule::from("a > 1 mm or a < 0 mm and b == 2", kKnown).measures(), (std::vector<std::string>{"a", "b"}));
}

TEST(Rule, RefusesWhatIsWrongWithItsPlace) {
  const auto refusal = [](const std::string& rule) {
    return tests::refusalOf<RuleError>([&] { Rule::from(rule, kKnown); });
  };
  for (const auto& [rule, word] :
       std::vector<std::pair<std::string, std::string>>{{"", "at letter 1: a comparison is missing"},
                                                        {"a > 1", "at letter 6: a is in mm"},
                                                        {"a > 1 s", "at letter 7: a is in mm"},
                                                        {"b > 1 mm", "b is a pure number"},
                                                        {"x > 1", "\"x\" is no measure"},
                                                        {"a 1 mm", "give < <= > >= or =="},
                                                        {"a = 1 mm", "give < <= > >= or =="},
                                                        {"a > mm", "give a number"},
                                                        {"a > 1e999 mm", "give a number"},
                                                        {"(b > 1", "a bracket is not closed"},
                                                        {"b > 1)", "\")\" is too much here"},
                                                        {"b > 1 and", "a comparison is missing"},
                                                        {"b > 1; b < 2", "give measures, numbers"},
                                                        {std::string(60, '('), "too many brackets"},
                                                        {std::string(301, 'b'), "longer than 300"}})
    EXPECT_NE(refusal(rule).find(word), std::string::npos) << rule << ": " << refusal(rule);
  std::string many = "b > 0";
  for (int n = 0; n < 30; ++n) many += " or b>0";
  EXPECT_NE(refusal(many).find("too long"), std::string::npos);
}

}  // namespace
}  // namespace app
