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
  EXPECT_EQ(shippedQuestionnaires(),
            (std::vector<std::string>{"vhu-7", "gajananan", "sus", "tlx-raw", "tlx-weighted", "debrief-5"}));
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

TEST(Questionnaire, TheWeightedLoadIndexComparesFifteenPairs) {
  const Questionnaire tlx = questionnaireNamed("tlx-weighted");
  ASSERT_EQ(tlx.items.size(), 21u);
  EXPECT_EQ(tlx.items[6].id, "mental-physical");
  EXPECT_EQ(tlx.items[20].id, "effort-frustration");
  EXPECT_EQ(tlx.items[20].choices, (std::vector<std::string>{"Effort", "Frustration"}));
  EXPECT_EQ(tlx.highOf(tlx.items[5]), 100);
  EXPECT_EQ(tlx.lowOf(tlx.items[6]), 1);
  EXPECT_EQ(tlx.highOf(tlx.items[6]), 2);
  // The first of each pair: weights 5 4 3 2 1 0, so (50 + 80 + 90 + 80 + 50 + 0) / 15.
  std::vector<std::optional<double>> answers{10, 20, 30, 40, 50, 60};
  answers.resize(21, 1.0);
  EXPECT_EQ(*weightsOf(tlx, answers), (std::vector<double>{5, 4, 3, 2, 1, 0}));
  EXPECT_NEAR(*scoreOf(tlx, answers), 350.0 / 15.0, 1e-12);
  // The second of each: 0 1 2 3 4 5, so (20 + 60 + 120 + 200 + 300) / 15.
  for (std::size_t n = 6; n < 21; ++n) answers[n] = 2.0;
  EXPECT_NEAR(*scoreOf(tlx, answers), 700.0 / 15.0, 1e-12);
  // Effort before mental demand alone: 4 for mental, 2 for effort.
  for (std::size_t n = 6; n < 21; ++n) answers[n] = tlx.items[n].id == "mental-effort" ? 2.0 : 1.0;
  EXPECT_EQ(*weightsOf(tlx, answers), (std::vector<double>{4, 4, 3, 2, 2, 0}));
  answers[9] = {};
  EXPECT_FALSE(scoreOf(tlx, answers)) << "one comparison is missing";
  EXPECT_FALSE(weightsOf(questionnaireNamed("tlx-raw"), {10, 20, 30, 40, 50, 60}));
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
  EXPECT_EQ(refusal(head + "scoring = \"categories\"\npublished_count = 10\n" + item + "published_mean = 4.5\n"),
            "accepted");
  for (const std::string& text : {
           head + "scoring = \"sum\"\n" + item,
           head + "scoring = \"weighted\"\n" + item,
           head + "scoring = \"sus\"\n" + item,
           head + "scoring = \"categories\"\n" + item + item,
           head + "scoring = \"categories\"\n[[item]]\nid = \"A\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\n[[item]]\nid = \"group\"\ncategory = \"C\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\n[[item]]\nid = \"A B\"\ncategory = \"C\"\nsays = \"Good\"\n",
           head + "scoring = \"categories\"\ncolour = 1\n" + item,
           head + "scoring = \"categories\"\n",
           head + "scoring = \"categories\"\n" + item + "published_mean = 4\n",
           head + "scoring = \"categories\"\npublished_count = 10\n" + item + "published_mean = 8\n",
           head + "scoring = \"categories\"\npublished_count = 10\n" + item + "published_deviation = -1\n",
           head + "scoring = \"categories\"\npublished_count = 1000\n" + item,
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
