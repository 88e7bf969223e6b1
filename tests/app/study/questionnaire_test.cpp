#include "app/study/questionnaire.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace app {
namespace {

TEST(Questionnaire, ShippedOnesAreWhole) {
  EXPECT_EQ(shippedQuestionnaires(), (std::vector<std::string>{"vhu-7", "gajananan", "sus", "tlx-raw", "debrief-5"}));
  for (const std::string& name : shippedQuestionnaires()) {
    const Questionnaire questionnaire = questionnaireNamed(name);
    EXPECT_EQ(questionnaire.id, name);
    EXPECT_FALSE(questionnaire.source.empty());
  }
  EXPECT_EQ(questionnaireNamed("vhu-7").items.size(), 18u);
  EXPECT_EQ(questionnaireNamed("vhu-7").categories().size(), 3u);
  EXPECT_EQ(questionnaireNamed("gajananan").items.size(), 20u);
  EXPECT_THROW(questionnaireNamed("nasa"), UsageError);
}

TEST(Questionnaire, ScoresByTheirAuthorsRules) {
  const Questionnaire sus = questionnaireNamed("sus");
  const auto score = [&](double odd, double even) {
    std::vector<std::optional<double>> answers;
    for (int n = 0; n < 10; ++n) answers.emplace_back(n % 2 == 0 ? odd : even);
    return answers;
  };
  EXPECT_EQ(scoreOf(sus, score(3, 3)), 50.0);
  EXPECT_EQ(scoreOf(sus, score(5, 1)), 100.0);
  EXPECT_EQ(scoreOf(sus, score(1, 5)), 0.0);
  EXPECT_EQ(scoreOf(sus, score(4, 2)), 75.0);
  auto answers = score(5, 1);
  answers[4].reset();
  EXPECT_EQ(scoreOf(sus, answers), 95.0) << "the middle takes the place of one";
  answers[5].reset();
  EXPECT_FALSE(scoreOf(sus, answers));

  const Questionnaire tlx = questionnaireNamed("tlx-raw");
  EXPECT_EQ(scoreOf(tlx, {10, 20, 30, 40, 50, 60}), 35.0);
  EXPECT_FALSE(scoreOf(tlx, {10, 20, 30, 40, 50, {}}));
}

TEST(Questionnaire, AWrongFileIsRefusedWithItsLine) {
  const on_disk::Folder folder;
  const std::string head =
      "id = \"x\"\ntitle = \"X\"\nsource = \"own\"\nlow = 1\nhigh = 7\nscale = [\"no\", \"yes\"]\n";
  const auto refusal = [&](const std::string& text) {
    on_disk::write(folder.at("own.toml"), text);
    return tests::refusalOf<assets::LoadError>([&] { questionnaireNamed(folder.at("own.toml")); });
  };
  const std::string item = "[[item]]\nid = \"A\"\ncategory = \"C\"\nsays = \"Good\"\n";
  EXPECT_EQ(refusal(head + "scoring = \"categories\"\n" + item), "accepted");
  for (const std::string& text : {
           head + "scoring = \"sum\"\n" + item,
           head + "scoring = \"sus\"\n" + item,
           head + "scoring = \"categories\"\n" + item + item,
           head + "scoring = \"categories\"\n[[item]]\nid = \"A\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\n[[item]]\nid = \"group\"\ncategory = \"C\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\n[[item]]\nid = \"A B\"\ncategory = \"C\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\ncolour = 1\n" + item,
           head + "scoring = \"categories\"\n",
           "id = \"x\"\ntitle = \"X\"\nsource = \"own\"\nlow = 5\nhigh = 3\nscale = [\"a\", \"b\"]\nscoring = "
           "\"mean\"\n" +
               item,
           "id = \"x\"\ntitle = \"X\"\nsource = \"own\"\nlow = 1\nhigh = 7\nscale = [\"a\", \"b\", \"c\"]\nscoring = "
           "\"mean\"\n" +
               item,
       }) {
    const std::string said = refusal(text);
    EXPECT_NE(said.find("own.toml"), std::string::npos) << text << said;
    EXPECT_NE(said.find("line"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace app
