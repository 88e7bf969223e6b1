#include "assets/patient/statement_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "assets/load_error.h"
#include "assets/patient/scan_origin_toml.h"
#include "calibration/record/machine_key.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace {

using assets::Seal;

/// A folder with a volume and its statement, and a place for the machine's key.
class Statement : public testing::Test {
 protected:
  void SetUp() override {
    setenv("XDG_CONFIG_HOME", folder_.at("config").c_str(), 1);
    std::filesystem::create_directories(folder_.at("patient"));
    on_disk::write(folder_.at("patient/volume.vdb"), "voxels");
    writeStatement();
  }
  void TearDown() override { unsetenv("XDG_CONFIG_HOME"); }

  void writeStatement() {
    const std::string digest = assets::digestOfFile(folder_.at("patient/volume.vdb"));
    on_disk::write(text_, assets::sealedStatement(assets::deidentificationStatement({}, digest)));
  }
  assets::StatementFacts facts() const { return *assets::statementIn(folder_.at("patient")); }
  /// In one line.
  std::string refusal() const {
    const std::string words =
        tests::refusalOf<assets::LoadError>([&] { assets::reviewStatement(folder_.at("patient")); });
    EXPECT_EQ(words.find('\n'), std::string::npos);
    return words;
  }
  void change(const std::string& from, const std::string& to) {
    std::string text = on_disk::read(text_);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    on_disk::write(text_, text.replace(at, from.size(), to));
  }

  const on_disk::Folder folder_;
  const std::string text_ = folder_.at("patient/deidentified.toml");
};

TEST_F(Statement, IsSignedByThisMachineAndReviewedByNobody) {
  EXPECT_EQ(facts().seal, Seal::of_this_machine);
  EXPECT_FALSE(facts().is_reviewed);
  EXPECT_TRUE(facts().is_of_volume);
  const auto key = std::filesystem::status(folder_.at("config/molar/machine.key")).permissions();
  EXPECT_EQ(key, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_FALSE(assets::statementIn(folder_.at("config")));
}

TEST_F(Statement, IsReviewedWhenAPersonSaysSo) {
  assets::reviewStatement(folder_.at("patient"));
  EXPECT_TRUE(facts().is_reviewed);
  EXPECT_EQ(facts().seal, Seal::of_this_machine);
  EXPECT_EQ(on_disk::read(text_).find("nobody"), std::string::npos);
  const std::string once = on_disk::read(text_);
  assets::reviewStatement(folder_.at("patient"));
  EXPECT_EQ(on_disk::read(text_), once);
}

TEST_F(Statement, AnyChangeIsSeen) {
  change("kept = false", "kept = true");
  EXPECT_EQ(facts().seal, Seal::broken);
  EXPECT_NE(
      tests::refusalOf<assets::LoadError>([&] { assets::reviewStatement(folder_.at("patient")); }).find("was changed"),
      std::string::npos);
  writeStatement();
  change("ed25519 = ", "ed25519 = \"00\" # ");
  EXPECT_EQ(facts().seal, Seal::broken);
  writeStatement();
  on_disk::write(folder_.at("patient/volume.vdb"), "other voxels");
  EXPECT_FALSE(facts().is_of_volume);
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] {
              assets::reviewStatement(folder_.at("patient"));
            }).find("another volume"),
            std::string::npos);
}

TEST_F(Statement, WhatStandsBehindTheSignatureIsAChange) {
  const std::string whole = on_disk::read(text_);
  for (const char* more : {"\n", "# more\n", "reviewed = true\n", "\n[face]\nkept = true\n"}) {
    on_disk::write(text_, whole + more);
    EXPECT_EQ(facts().seal, Seal::broken) << more;
    EXPECT_NE(refusal().find("was changed"), std::string::npos) << more;
    EXPECT_EQ(on_disk::read(text_), whole + more);
  }
}

TEST_F(Statement, WithoutItsSignatureIsReviewedOnlyWhereNoneCanBeMade) {
  const std::string whole = on_disk::read(text_), bare = whole.substr(0, whole.find("\n[signature]\n"));
  ASSERT_LT(bare.size(), whole.size());
  on_disk::write(text_, bare);
  EXPECT_EQ(facts().seal, Seal::none);
  EXPECT_NE(refusal().find("carries no signature"), std::string::npos);
  EXPECT_EQ(on_disk::read(text_), bare);
  on_disk::write(folder_.at("blocked"), "a file");
  setenv("XDG_CONFIG_HOME", folder_.at("blocked").c_str(), 1);
  assets::reviewStatement(folder_.at("patient"));
  EXPECT_TRUE(facts().is_reviewed);
  EXPECT_EQ(facts().seal, Seal::none);
}

TEST_F(Statement, AnotherMachinesSealIsTold) {
  setenv("XDG_CONFIG_HOME", folder_.at("elsewhere").c_str(), 1);
  EXPECT_EQ(facts().seal, Seal::of_another_machine);
  // Where no key can be kept there is no signature.
  on_disk::write(folder_.at("blocked"), "a file");
  setenv("XDG_CONFIG_HOME", folder_.at("blocked").c_str(), 1);
  writeStatement();
  EXPECT_EQ(facts().seal, Seal::none);
}

// RFC 8032, 7.1, test 2.
TEST(MachineKey, ChecksAKnownSignature) {
  const calibration::TextSignature known{"3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c",
                                         "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e159"
                                         "96e458f3613d0f11d8c387b2eaeb4302aeeb00d"
                                         "291612bb0c00"};
  EXPECT_TRUE(calibration::isSignatureOf("\x72", known));
  EXPECT_FALSE(calibration::isSignatureOf("\x73", known));
  EXPECT_FALSE(calibration::isSignatureOf("\x72", {known.public_key, "x"}));
}

}  // namespace
