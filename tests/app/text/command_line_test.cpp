#include "app/text/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "app/text/help_page.h"
#include "app/text/suggestion.h"
#include "app/text/usage_error.h"
#include "tests/app/text/sample_program.h"
#include "tests/refusal.h"

namespace app {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string refusalOf(std::vector<const char*> words) {
  words.insert(words.begin(), "molar");
  SampleProgram surgery;
  return tests::refusalOf<UsageError>([&] { surgery.program.run(static_cast<int>(words.size()), words.data()); });
}

TEST(CommandLine, NamesTheClosestCommandOrOption) {
  EXPECT_EQ(refusalOf({"cutt"}), "cutt: no such command, did you mean cut? see molar --help");
  EXPECT_EQ(refusalOf({"close", "stich"}), "stich: no such command, did you mean stitch? see molar close --help");
  EXPECT_EQ(refusalOf({"anaesthesia"}), "anaesthesia: no such command, see molar --help");
  EXPECT_EQ(refusalOf({"cut", "P", "--out", "F", "--qick"}),
            "cut --qick: no such option, did you mean --quick? see molar cut --help");
  EXPECT_EQ(refusalOf({"close"}), "close: a command is missing, see molar close --help");
  EXPECT_THAT(refusalOf({"cut", "P", "Q", "--out", "F"}), HasSubstr("cut Q: one word too many"));
}

TEST(CommandLine, RefusesAValueWithTheOnesThatArePossibleAndTheCommandsHelp) {
  const std::string mode = refusalOf({"cut", "P", "--out", "F", "--mode", "volume"});
  EXPECT_THAT(mode, HasSubstr("volume is not possible, give one of iso, dvr"));
  EXPECT_THAT(mode, HasSubstr("see molar cut --help"));
  for (const char* bad : {"0", "21", "x", "1.5"})
    EXPECT_THAT(refusalOf({"close", "stitch", "--most", bad}), HasSubstr("give a whole number from 1 to 20")) << bad;
}

TEST(CommandLine, ACommandMayTakeWordsOfItsOwnBesideCommands) {
  const auto said = [](std::vector<const char*> words) {
    words.insert(words.begin(), "molar");
    CommandLine program("An operation", "1.2");
    CommandLine& ward = program.command("ward", "A ward");
    std::string of, bed, did;
    ward.option("WARD", of, "Which");
    ward.does([&] { return did = "looked at " + of, 0; });
    CommandLine& clean = ward.command("clean", "Cleans");
    clean.option("BED", bed, "Which").required();
    clean.does([&] { return did = "cleaned " + bed, 0; });
    program.run(static_cast<int>(words.size()), words.data());
    EXPECT_THAT(helpPage("molar ward", ward.help(), {.width = 80, .coloured = false}),
                HasSubstr("molar ward [COMMAND] [OPTIONS] [WARD]"));
    return did;
  };
  EXPECT_EQ(said({"ward"}), "looked at ");
  EXPECT_EQ(said({"ward", "north"}), "looked at north");
  EXPECT_EQ(said({"ward", "clean", "7"}), "cleaned 7");
  EXPECT_THAT(tests::refusalOf<UsageError>([&] { said({"ward", "north", "south"}); }), HasSubstr("one word too many"));
  EXPECT_THAT(tests::refusalOf<UsageError>([&] { said({"ward", "clean"}); }), Not(HasSubstr("command is missing")));
}

TEST(HelpPage, ListsExamplesGroupsRangesAndDefaultsInPlainWords) {
  CommandLine program("An operation", "1.2");
  CommandLine& cut = program.command("cut", "Cuts");
  double depth_mm = 2.5;
  std::string site;
  cut.example("molar cut --depth 3", "a deep cut");
  cut.optionGroup("Patient");
  Option at = cut.option("--site", site, "Where");
  cut.optionGroup("Hand");
  cut.option("--depth", depth_mm, "How deep, mm").from(0.0, 8.0).showsDefault().excludes(at);
  program.command("measure", "Measures").forEngineers();
  const std::string page = helpPage("molar cut", cut.help(), {.width = 80, .coloured = false});
  EXPECT_THAT(page, HasSubstr("Examples\n  molar cut --depth 3\n      a deep cut\n"));
  EXPECT_THAT(page, HasSubstr("\nPatient\n  --site TEXT"));
  EXPECT_THAT(page, HasSubstr("\nHand\n  --depth NUMBER              How deep, mm, 0 to 8 [2.5]\n"));
  for (const char* parser_speech : {"FLOAT", "Excludes", "in [", "Needs", "REQUIRED"})
    EXPECT_THAT(page, Not(HasSubstr(parser_speech)));
  const std::string all = helpPage("molar", program.help(), {.width = 80, .coloured = false});
  EXPECT_LT(all.find("\nCommands\n  cut"), all.find("\nFor engineers\n  measure"));
}

TEST(EditDistance, CountsEditsAndIsAMetricOnRandomWords) {
  EXPECT_EQ(editDistance("reherse", "rehearse"), 1u);
  EXPECT_EQ(editDistance("rehaerse", "rehearse"), 1u) << "two neighbours swapped";
  EXPECT_EQ(editDistance("", "abc"), 3u);
  std::mt19937 rng(7);
  const auto word = [&] {
    std::string text(rng() % 6, 'a');
    for (char& c : text) c = static_cast<char>('a' + rng() % 3);
    return text;
  };
  for (int n = 0; n < 500; ++n) {
    const std::string a = word(), b = word();
    EXPECT_EQ(editDistance(a, b), editDistance(b, a));
    EXPECT_EQ(editDistance(a, b) == 0, a == b);
    EXPECT_LE(editDistance(a, b), std::max(a.size(), b.size()));
    EXPECT_EQ(editDistance(a + "x", b + "x"), editDistance(a, b)) << a << " " << b;
  }
}

TEST(DidYouMean, FindsTyposAndBeginningsButNothingFar) {
  const std::vector<std::string> names = {"rehearse", "replay", "report", "metrics"};
  EXPECT_EQ(closestName("rehearsal", names), "rehearse");
  EXPECT_EQ(closestName("metr", names), "metrics");
  EXPECT_EQ(closestName("volume", names), "");
  EXPECT_EQ(closestName("", names), "");
}

}  // namespace
}  // namespace app
