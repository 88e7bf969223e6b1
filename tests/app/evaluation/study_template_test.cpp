#include "app/evaluation/study_template.h"

#include <gtest/gtest.h>

#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "tests/refusal.h"

namespace app {
namespace {

const std::string kGood = R"(title = "Round 1"
language = "en"
case = "usual"
consent = "consent.md"
order = "latin-square"
seed = 3
[warm_up]
block = "block-plate"
seconds = 20
[may_change]
law = true
[[prompt]]
id = "why"
say = "Why?"
[[task]]
id = "open"
say = "Open the bone"
tool = "round:3.0"
time_box_s = 60
success = "O1.removed >= 2 mm3"
fail = "S1.canal < 0 mm"
hold_s = 0.5
at_time_box = "partly"
[[task]]
id = "widen"
say = "Widen it"
time_box_s = 30
success = "time > 2 s"
[[questionnaire]]
use = "sus"
groups = ["surgeon"]
)";

std::string refusalOf(const std::string& text) {
  return tests::refusalOf<assets::LoadError>([&] { studyTemplateFrom(text, "t.toml"); });
}

std::string with(const std::string& what, const std::string& instead) {
  std::string text = kGood;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

TEST(StudyTemplate, ReadsEveryKey) {
  const StudyTemplate study = studyTemplateFrom(kGood, "t.toml");
  EXPECT_EQ(study.title, "Round 1");
  EXPECT_EQ(study.case_name, "usual");
  EXPECT_EQ(study.order, OrderKind::latin_square);
  EXPECT_EQ(study.seed, 3u);
  EXPECT_EQ(study.warm_up_block, "block-plate");
  EXPECT_EQ(study.warm_up_s, 20.0);
  EXPECT_TRUE(study.law_may_change && study.layers_may_change);
  ASSERT_EQ(study.tasks.size(), 2u);
  EXPECT_EQ(study.tasks[0].success.text(), "O1.removed >= 2 mm3");
  EXPECT_EQ(study.tasks[0].fail.value().text(), "S1.canal < 0 mm");
  EXPECT_EQ(study.tasks[0].hold_s, 0.5);
  EXPECT_EQ(study.tasks[0].at_time_box, AtTimeBox::partly);
  EXPECT_EQ(study.tasks[1].at_time_box, AtTimeBox::ask);
  EXPECT_EQ(study.tools(), std::vector<std::string>{"round:3.0"});
  EXPECT_EQ(study.questionnairesFor("surgeon").size(), 1u);
  EXPECT_TRUE(study.questionnairesFor("student").empty());
}

TEST(StudyTemplate, TheShippedOnesAreGood) {
  for (const char* const name : {"example.toml", "gajananan.toml"})
    EXPECT_EQ(refusalOf(assets::readSmallFile(std::string(MOLAR_SOURCES) + "/app/evaluation/" + name)), "accepted")
        << name;
}

TEST(StudyTemplate, NamesWhatIsDoneToOneTooth) {
  const StudyTemplate study =
      studyTemplateFrom(assets::readSmallFile(std::string(MOLAR_SOURCES) + "/app/evaluation/gajananan.toml"), "g.toml");
  EXPECT_EQ(study.operation.task, "preparation");
  EXPECT_EQ(study.operation.tooth, 46);
  EXPECT_EQ(study.operation.ideal, "class-1");
  EXPECT_EQ(study.operation.preset, "density-weighted");
  EXPECT_EQ(study.tools(),
            (std::vector<std::string>{"sphere:0.6", "cylinder:0.6,1.4", "capsule:0.5,0.6", "cone:0.6,1.6"}));
  EXPECT_TRUE(studyTemplateFrom(kGood, "t.toml").operation.task.empty());
}

TEST(StudyTemplate, BrokenOnesAreRefusedWithFileLineAndKey) {
  struct Broken {
    std::string text, line, key;
  };
  const std::vector<Broken> broken{
      {with("title = \"Round 1\"", "title = \"\""), "line 1:", "title"},
      {with("title = \"Round 1\"", "titel = \"Round 1\""), "", "title"},
      {with("language = \"en\"", "language = \"E N\""), "line 2:", "language"},
      {with("case = \"usual\"", "case = \"unusual\""), "line 3:", "case"},
      {with("case = \"usual\"", "case = 3"), "line 3:", "case"},
      {with("consent = \"consent.md\"", "consent = \"/etc/passwd\""), "line 4:", "consent"},
      {with("consent = \"consent.md\"", "consent = \"..\""), "line 4:", "consent"},
      {with("consent = \"consent.md\"\n", ""), "", "consent"},
      {with("latin-square", "random"), "line 5:", "order"},
      {with("seed = 3", "seed = -1"), "line 6:", "seed"},
      {with("seed = 3", "seed = 1.5"), "line 6:", "seed"},
      {with("seed = 3", "retention_days = 0"), "line 6:", "retention_days"},
      {with("block-plate", "block-plat"), "line 8:", "block"},
      {with("seconds = 20", "seconds = 0"), "line 9:", "seconds"},
      {with("law = true", "law = 1"), "line 11:", "law"},
      {with("law = true", "force = true"), "line 11:", "force"},
      {with("id = \"why\"", "id = \"Why?\""), "line 13:", "id"},
      {with("say = \"Why?\"", "say = 1"), "line 14:", "say"},
      {with("id = \"open\"", "id = \"\""), "line 16:", "id"},
      {with("id = \"open\"", "id = \"debrief\""), "line 16:", "id"},
      {with("say = \"Open the bone\"\n", ""), "line 15:", "say"},
      {with("round:3.0", "sphere:-1"), "line 18:", "tool"},
      {with("time_box_s = 60", "time_box_s = \"60\""), "line 19:", "time_box_s"},
      {with("time_box_s = 60", "time_box_s = 0"), "line 19:", "time_box_s"},
      {with("success = \"O1.removed >= 2 mm3\"\n", ""), "line 15:", "success"},
      {with("O1.removed >= 2 mm3", "O1.removed >= 2"), "line 20:", "success"},
      {with("O1.removed >= 2 mm3", "O2.trough >= 0.9"), "line 20:", "success"},
      {with("S1.canal < 0 mm", "S1.canal < 0 N"), "line 21:", "fail"},
      {with("hold_s = 0.5", "hold_s = -1"), "line 22:", "hold_s"},
      {with("\"partly\"", "\"success\""), "line 23:", "at_time_box"},
      {with("id = \"widen\"", "id = \"open\""), "line 25:", "id"},
      {with("success = \"time > 2 s\"", "sucess = \"time > 2 s\""), "line 24:", "success"},
      {with("use = \"sus\"", "use = \"suss\""), "line 30:", "use"},
      {with("use = \"sus\"", "use = \"none.toml\""), "line 30:", "use"},
      {with("groups = [\"surgeon\"]", "groups = \"surgeon\""), "line 31:", "groups"},
      {with("groups = [\"surgeon\"]", "groups = [\"surgeon\"]\n[[questionnaire]]\nuse = \"sus\""), "line 33:", "use"},
      {with("[may_change]", "[may_chang]"), "may_chang", "may_chang"},
      {with("seed = 3", "seed ="), "line 6:", "TOML"},
      {with("[[prompt]]", "[prompt]"), "", "prompt"},
      {kGood.substr(0, kGood.find("[[task]]")), "", "task"},
      {with("[may_change]", "[operation]\ntask = \"extracting\"\n[may_change]"), "line 11:", "task"},
      {with("[may_change]", "[operation]\ntooth = 46\n[may_change]"), "line 11:", "tooth"},
      {with("[may_change]", "[operation]\ntask = \"preparation\"\ntooth = 99\n[may_change]"), "line 12:", "tooth"},
      {with("[may_change]", "[operation]\ntask = \"root-canal\"\nideal = \"class-1\"\n[may_change]"),
       "line 12:", "ideal"},
      {with("[may_change]", "[operation]\npreset = \"usual\"\n[may_change]"), "line 11:", "preset"},
      {with("[may_change]", "[operation]\ntask = \"preparation\"\nside = \"left\"\n[may_change]"), "line 12:", "side"},
  };
  EXPECT_GE(broken.size(), 30u);
  for (const Broken& one : broken) {
    const std::string refusal = refusalOf(one.text);
    EXPECT_NE(refusal, "accepted") << one.text;
    EXPECT_NE(refusal.find("t.toml"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(one.line), std::string::npos) << one.line << " / " << refusal;
    EXPECT_NE(refusal.find(one.key), std::string::npos) << one.key << " / " << refusal;
  }
}

}  // namespace
}  // namespace app
