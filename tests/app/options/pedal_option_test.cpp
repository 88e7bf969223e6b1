#include "app/options/pedal_option.h"

#include <fstream>

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using haptics::HandAction;

TEST(PedalOption, ReadsThePedalAndItsSwitches) {
  EXPECT_FALSE(pedalFrom("none"));
  EXPECT_EQ(pedalFrom("auto")->wanted, "auto");
  EXPECT_TRUE(pedalFrom("auto")->mapping.empty());
  EXPECT_EQ(pedalFrom("/dev/input/event4")->wanted, "/dev/input/event4");
  const auto choice = pedalFrom("VEC Footpedal,BTN_0=undo,-ABS_Z=irrigation");
  ASSERT_EQ(choice->mapping.size(), 2u);
  EXPECT_EQ(choice->wanted, "VEC Footpedal");
  EXPECT_EQ(choice->mapping[0].control, "BTN_0");
  EXPECT_EQ(choice->mapping[0].action, HandAction::undo);
  EXPECT_EQ(choice->mapping[1].control, "-ABS_Z");
}

TEST(PedalOption, AcceptsTheCurrentAndTheFormerNameOfAToolChange) {
  for (const char* text : {"auto,KEY_B=tool", "auto,KEY_B=tool-change"})
    EXPECT_EQ(pedalFrom(text)->mapping.at(0).action, HandAction::tool_change) << text;
}

TEST(PedalOption, RefusesInvalidText) {
  for (const char* text : {"", ",KEY_B=drill", "auto,KEY_B", "auto,", "auto,KEY_B=dril", "auto,KEY_NONE=drill",
                           "auto,=", "auto,KEY_B=drill,", "/no/such/file.toml"})
    EXPECT_THROW(pedalFrom(text), std::runtime_error) << text;
}

TEST(PedalOption, ReadsAFile) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("pedal.toml");
  const auto reading = [&](const std::string& text) {
    std::ofstream(path) << text;
    return pedalFrom(path);
  };
  const auto choice = reading(
      "device = \"CH Pro\"\n[actions]\nABS_GAS = \"drill\"\n\"+ABS_Z\" = \"tool-change\"\n[thresholds]\nABS_GAS = "
      "0.3\n");
  EXPECT_EQ(choice->wanted, "CH Pro");
  ASSERT_EQ(choice->mapping.size(), 2u);
  for (const haptics::PedalBinding& one : choice->mapping) {
    EXPECT_EQ(one.action, one.control == "ABS_GAS" ? HandAction::drill : HandAction::tool_change);
    EXPECT_EQ(one.threshold, one.control == "ABS_GAS" ? 0.3 : 0.5);
  }
  EXPECT_EQ(reading("")->wanted, "auto");
  for (const char* text : {"device = 3\n", "[actions]\nKEY_B = \"sing\"\n", "[actions]\nKEY_Ö = \"drill\"\n",
                           "[actions]\nABS_Z = \"drill\"\n[thresholds]\nABS_Z = 2\n", "[thresholds]\nABS_Z = 0.5\n",
                           "[thresholds]\nABS_Z = nan\n[actions]\nABS_Z = \"drill\"\n", "speed = 1\n", "\xff"})
    EXPECT_THROW(reading(text), std::runtime_error) << text;
}

}  // namespace
}  // namespace app
