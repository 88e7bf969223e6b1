#include "app/text/shell_completion.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "tests/app/text/sample_program.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// Completions of bash for a line whose last word is being typed.
std::string offered(const std::string& words) {
  const SampleProgram surgery;
  const tests::ScratchFolder folder;
  const std::string script = folder.file("completion.bash");
  std::ofstream(script) << bashCompletion("surgery", surgery.program.help());
  const std::string ask = ". '" + script + "'; COMP_WORDS=(" + words +
                          "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _surgery; echo \"${COMPREPLY[*]}\"";
  std::FILE* const shell = ::popen(("bash -c '" + ask + "' 2>&1").c_str(), "r");
  std::string said;
  char line[1000];
  while (std::fgets(line, sizeof line, shell) != nullptr) said += line;
  ::pclose(shell);
  return said;
}

TEST(ShellCompletion, OffersCommandsThenOptionsThenChoices) {
  EXPECT_EQ(offered("surgery c"), "cut close\n");
  EXPECT_EQ(offered("surgery \"\""), "cut close -h --help --version\n");
  EXPECT_EQ(offered("surgery cut --"), "--out --mode --quick --help\n");
  EXPECT_EQ(offered("surgery cut somebody --mode d"), "dvr\n");
  EXPECT_EQ(offered("surgery close \"\""), "stitch -h --help\n");
  EXPECT_EQ(offered("surgery close stitch -"), "--most -h --help\n");
}

TEST(ShellCompletion, LeavesFilesToTheShell) {
  EXPECT_EQ(offered("surgery cut som"), "\n");
  EXPECT_EQ(offered("surgery cut --out som"), "\n");
}

}  // namespace
}  // namespace app
