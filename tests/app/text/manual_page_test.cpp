#include "app/text/manual_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/app/text/sample_program.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using testing::HasSubstr;

TEST(ManualPage, SaysWhatTheCommandLineSays) {
  const SampleProgram surgery;
  const CommandHelp words = surgery.program.help();
  ASSERT_EQ(words.commands.size(), 2u);
  const std::string page = manualPage("molar cut", words.commands[0], "Molar 1.2");
  EXPECT_THAT(page, HasSubstr(".TH \"MOLAR-CUT\" 1 \"\" \"Molar 1.2\" \"Molar\"\n"));
  EXPECT_THAT(page, HasSubstr("\\fBmolar cut\\fR \\fB\\-\\-out\\fR \\fIFILE\\fR [\\fIOPTIONS\\fR] \\fIPATIENT\\fR\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-mode\\fR \\fITEXT\\fR\nHow it looks. One of iso, dvr [iso]\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-q\\fR, \\fB\\-\\-quick\\fR\nIn a hurry\n"));
  EXPECT_THAT(page, HasSubstr("\\fBmolar\\fR(1)"));
  EXPECT_THAT(manualPage("molar close", words.commands[1], "Molar 1.2"),
              HasSubstr("\\fBmolar\\-close\\-stitch\\fR(1)\nWith thread\n"));
  EXPECT_EQ(manualFile("molar close stitch"), "molar-close-stitch.1");
}

TEST(ManualPage, TakesNoTextForARequest) {
  const SampleProgram surgery;
  const std::string page = manualPage("molar cut", surgery.program.help().commands[0], "Molar 1.2");
  EXPECT_THAT(page, HasSubstr("Cuts \\- .what is there\\e\n"));
  EXPECT_THAT(page, HasSubstr("\\&.a line\n\\&'another\n"));
}

TEST(ManualPage, IsReadByGroffWithoutAWord) {
  if (std::system("command -v groff >/dev/null") != 0)
    GTEST_SKIP() << "groff is not installed (apt-get install groff-base)";
  const SampleProgram surgery;
  const tests::ScratchFolder folder;
  const std::string file = folder.file("molar-cut.1");
  std::ofstream(file) << manualPage("molar cut", surgery.program.help().commands[0], "Molar 1.2");
  const std::string said = file + ".said";
  ASSERT_EQ(std::system(("groff -K utf8 -man -Tutf8 -ww '" + file + "' >/dev/null 2>'" + said + "'").c_str()), 0);
  EXPECT_EQ(std::filesystem::file_size(said), 0u);
}

}  // namespace
}  // namespace app
