#include "app/options/live_parameters.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/options/command_settings.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using namespace std::chrono_literals;

haptics::Command read(const std::string& text, const haptics::Command& base = {}) {
  assets::TomlReader keys(text, "feel.toml");
  return commandFromToml(keys, base);
}

void expectRefused(const std::string& text, const std::string& words) {
  try {
    read(text);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(CommandFromToml, ReadsTheExample) {
  const std::string path = std::string(MOLAR_SOURCES) + "/app/options/feel.toml";
  const haptics::Command command = read(assets::readSmallFile(path));
  EXPECT_EQ(command.law.kind, haptics::LawKind::agus);
  EXPECT_EQ(command.law.agus.stiffness_N_per_mm, 0.8);
  EXPECT_EQ(command.spindle.commanded_rpm, 40000.0);
}

TEST(CommandFromToml, ChangesOnlyTheKeysInTheFile) {
  haptics::Command base;
  base.safety.peak_force_N = 2.0;
  const haptics::Command command =
      read("[law]\nname = \"forssim\"\nforce_constant_N = 0.5\n[tool]\nhead = \"cylinder:1,3\"\n", base);
  EXPECT_EQ(command.law.kind, haptics::LawKind::forssim);
  EXPECT_EQ(command.law.forssim.force_constant_N, 0.5);
  EXPECT_EQ(command.tool.head.kind, haptics::ShapeKind::cylinder);
  EXPECT_EQ(command.safety.peak_force_N, 2.0);
}

TEST(CommandFromToml, RefusesWithFileLineAndKey) {
  expectRefused("[law]\nname = \"agus\"\nstiffness_N_per_mm = -1\n", "feel.toml: line 3: [law] stiffness_N_per_mm");
  expectRefused("[law]\nforce_constant_N = 0.5\n", "line 2: [law] force_constant_N");
  expectRefused("[law]\nname = \"spring\"\n", "forssim");
  expectRefused("[erosion]\nname = \"acid\"\n", "dose");
  expectRefused("[tool]\nhead = \"hammer\"\n", "line 2: [tool] head");
  expectRefused("[colours]\nred = 1\n", "[colours]");
  expectRefused("[law\n", "line 1");
}

TEST(Settings, WornAppliesToForceAndErosion) {
  haptics::Command command;
  command.law.kind = haptics::LawKind::machining;
  applyTo(command, {"worn=0.5"});
  EXPECT_EQ(command.erosion.worn, 0.5);
  EXPECT_EQ(command.law.machining.worn, 0.5);
}

TEST(Settings, ListChangesWithUnits) {
  haptics::Command before, after;
  after.law.agus.stiffness_N_per_mm = 1.2;
  after.safety.peak_force_N = 3.0;
  EXPECT_EQ(changesBetween(before, after),
            (std::vector<std::string>{"[law] stiffness_N_per_mm 0.8 -> 1.2 N/mm", "[safety] peak_force_N 3.3 -> 3 N"}));
  EXPECT_TRUE(changesBetween(before, before).empty());
}

TEST(Settings, RefuseWhatADeviceCanNotRenderAndNameTheLimit) {
  haptics::Command command;
  EXPECT_NO_THROW(refuseUnlessStable(command, 0.002, 1000.0));
  command.law.agus.stiffness_N_per_mm = 10.0;
  try {
    refuseUnlessStable(command, 0.002, 1000.0);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("2b/T"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("stiffness_N_per_mm to "), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(refuseUnlessStable(command, 0.002, 10000.0)) << "ten times the rate allows ten times the stiffness";
  command = {};
  command.law.kind = haptics::LawKind::harmonic;
  command.tool.head = {haptics::ShapeKind::cone, 1.0, 2.0};
  EXPECT_THROW(refuseUnlessStable(command, 0.002, 1000.0), UsageError);
}

TEST(Settings, LowerALawToTheLimitOfTheDevice) {
  for (const haptics::LawName& law : haptics::kLaws)
    for (const double radius_mm : {0.5, 1.5, 4.0}) {
      haptics::Command command;
      command.law.kind = law.kind;
      command.tool.head.radius_mm = radius_mm;
      EXPECT_NO_THROW(refuseUnlessStable(loweredUntilStable(command, 0.002, 1000.0), 0.002, 1000.0)) << law.key;
    }
  haptics::Command soft;
  soft.law.agus.stiffness_N_per_mm = 0.3;
  EXPECT_EQ(loweredUntilStable(soft, 0.002, 1000.0).law.agus.stiffness_N_per_mm, 0.3)
      << "an admissible gain is unchanged";
}

class LiveFile : public testing::Test {
 protected:
  /// Each writing is a second later, whatever the file system's clock can tell apart.
  void write(const std::string& text) {
    std::ofstream(path_) << text;
    std::filesystem::last_write_time(path_, std::filesystem::file_time_type(std::chrono::seconds(1'000'000 + ++n_)));
  }
  tests::ScratchFolder folder_;
  std::string path_ = folder_.file("parameters.toml");
  int n_ = 0;
};

TEST_F(LiveFile, IsReadAgainAfterAChangeAndIgnoredWhenInvalid) {
  write("[law]\nstiffness_N_per_mm = 0.5\n");
  LiveParameters live(path_, {}, [](const haptics::Command& c) { refuseUnlessStable(c, 0.002, 1000.0); });
  EXPECT_EQ(live.first().law.agus.stiffness_N_per_mm, 0.5);
  auto now = LiveParameters::Clock::now() + 1s;
  EXPECT_FALSE(live.poll(now)) << "nothing changed";

  write("[law]\nstiffness_N_per_mm = 0.7\n");
  EXPECT_FALSE(live.poll(now + 100ms)) << "polled a tenth of a second ago";
  auto reading = live.poll(now += 300ms);
  ASSERT_TRUE(reading && reading->command);
  EXPECT_EQ(reading->command->law.agus.stiffness_N_per_mm, 0.7);

  for (const std::string bad : {"[law]\nstiffness_N_per_mm = \"soft\"\n", "[law", "[law]\nstiffness_N_per_mm = 15\n"}) {
    write(bad);
    reading = live.poll(now += 300ms);
    ASSERT_TRUE(reading) << bad;
    EXPECT_FALSE(reading->command);
    EXPECT_NE(reading->error.find(path_), std::string::npos) << reading->error;
    EXPECT_NE(reading->error.find("the old values stay"), std::string::npos) << reading->error;
    EXPECT_FALSE(live.poll(now += 300ms)) << "reported once";
  }
  std::filesystem::remove(path_);
  reading = live.poll(now += 300ms);
  ASSERT_TRUE(reading);
  EXPECT_FALSE(reading->error.empty());

  write("");
  reading = live.poll(now += 300ms);
  ASSERT_TRUE(reading && reading->command);
  EXPECT_EQ(reading->command->law.agus.stiffness_N_per_mm, 0.8) << "missing keys keep their initial value";
}

}  // namespace
}  // namespace app
