#include "app/start_screen/kept_choices.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/start_screen/start_lists.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

class KeptChoices : public testing::Test {
 protected:
  KeptChoices() { setenv("XDG_DATA_HOME", scratch_.file("data").c_str(), 1); }
  ~KeptChoices() override { unsetenv("XDG_DATA_HOME"); }
  std::string file() const { return scratch_.file("data") + "/molar/start-choices"; }

  tests::ScratchFolder scratch_;
};

TEST_F(KeptChoices, AreChosenAgainAtTheNextStart) {
  EXPECT_TRUE(keptChoices().empty());
  StartMenu menu(startLists({}));
  menu.choose(0, 5), menu.choose(1, 1), menu.choose(3, 1), menu.choose(5, 2);
  keepChoices(menu.chosenWords());
  StartMenu next(startLists({}));
  next.chooseAsIn(keptChoices());
  EXPECT_EQ(next.chosenWords(), menu.chosenWords());
  EXPECT_EQ(next.arguments(), menu.arguments());
}

TEST_F(KeptChoices, DamagedOrForeignOnesAreLeftOut) {
  const StartMenu usual(startLists({}));
  keepChoices(usual.chosenWords());
  for (const std::string& text : {std::string(), std::string("\0\xff\n\n", 4), std::string(100'000, 'x'),
                                  std::string("a\nb\nc\nd\ne\nf\n"), std::string("Demonstration\nMouse\n")}) {
    std::ofstream(file(), std::ios::binary) << text;
    StartMenu menu(startLists({}));
    menu.chooseAsIn(keptChoices());
    EXPECT_EQ(menu.arguments(), usual.arguments());
  }
}

TEST_F(KeptChoices, WithoutAFolderNothingIsKept) {
  std::ofstream(scratch_.file("data")) << "a file, not a folder";
  keepChoices({"x"});
  EXPECT_TRUE(keptChoices().empty());
}

}  // namespace
}  // namespace app
