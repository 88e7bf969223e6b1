#include "calibration/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/refusal.h"

namespace {

namespace fs = std::filesystem;
using calibration::CalibrationError;
using calibration::OutputFile;
using calibration::OutputFolder;

class Output : public testing::Test {
 protected:
  Output() { fs::create_directory(folder_); }
  ~Output() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  static void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
  static std::string read(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_ =
      fs::temp_directory_path() / ("molar_output_" + std::to_string(::getpid()) + "_" +
                                   std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

std::string refusalOf(const auto& act) {
  return tests::refusalOf<CalibrationError>([&] { act(); });
}

TEST_F(Output, AppearsCompleteAtCommitAndNotBefore) {
  OutputFile file(at("a.nrrd"), false);
  write(file.temporaryPath(), "voxels");
  EXPECT_FALSE(fs::exists(at("a.nrrd")));
  file.commit();
  EXPECT_EQ(read(at("a.nrrd")), "voxels");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Output, LeavesNothingWhenNotCommitted) {
  {
    OutputFile file(at("a.nrrd"), false);
    write(file.temporaryPath(), "half");
    OutputFolder folder(at("p"), false, {});
    write(folder.temporaryPath() + "/x", "half");
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(Output, TemporaryHasTheTargetsExtension) {
  OutputFile file(at("a.nii.gz"), false);
  EXPECT_THAT(file.temporaryPath(), testing::EndsWith("a.nii.gz"));
}

TEST_F(Output, ReplacesOnlyWithPermission) {
  write(at("a"), "old");
  EXPECT_THAT(refusalOf([&] { OutputFile(at("a"), false); }), testing::HasSubstr("--force"));
  OutputFile file(at("a"), true);
  write(file.temporaryPath(), "new");
  EXPECT_EQ(read(at("a")), "old");
  file.commit();
  EXPECT_EQ(read(at("a")), "new");
}

TEST_F(Output, DoesNotReplaceAFileCreatedMeanwhile) {
  OutputFile file(at("a"), false);
  write(at("a"), "someone else's");
  EXPECT_THROW(file.commit(), CalibrationError);
  EXPECT_EQ(read(at("a")), "someone else's");
}

TEST_F(Output, WritesThroughALink) {
  write(at("real"), "old");
  fs::create_symlink(at("real"), at("link"));
  OutputFile file(at("link"), true);
  write(file.temporaryPath(), "new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(read(at("real")), "new");
}

TEST_F(Output, RefusesInvalidTargets) {
  EXPECT_THAT(refusalOf([&] { OutputFile(at("no/such/a"), false); }), testing::HasSubstr("there is no folder"));
  EXPECT_THAT(refusalOf([&] { OutputFile(folder_.string(), true); }), testing::HasSubstr("folder"));
  EXPECT_THAT(refusalOf([&] { OutputFile("/dev/null", true); }), testing::HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { OutputFile("", true); }), testing::HasSubstr("empty"));
  EXPECT_THAT(refusalOf([&] { OutputFile("/proc/a", true); }), testing::HasSubstr("cannot write"));
  write(at("file"), "");
  EXPECT_THAT(refusalOf([&] { OutputFile(at("file/a"), false); }), testing::HasSubstr("there is no folder"));
}

TEST_F(Output, FolderAppearsAndIsReplacedCompletely) {
  for (const std::string text : {"first", "second"}) {
    OutputFolder folder(at("p/"), true, {"x", "y"});
    write(folder.temporaryPath() + "/x", text);
    if (text == "first") write(folder.temporaryPath() + "/y", text);
    folder.commit();
    EXPECT_EQ(read(at("p/x")), text);
  }
  EXPECT_FALSE(fs::exists(at("p/y")));
  EXPECT_EQ(entries(), 1);
}

TEST_F(Output, ExistingFolderNeedsPermissionUnlessEmpty) {
  fs::create_directory(at("p"));
  OutputFolder first(at("p"), false, {"x"});
  write(first.temporaryPath() + "/x", "1");
  first.commit();
  EXPECT_EQ(read(at("p/x")), "1");
  EXPECT_THAT(refusalOf([&] { OutputFolder(at("p"), false, {"x"}); }), testing::HasSubstr("--force"));
}

TEST_F(Output, NeverReplacesAFolderWithOtherContents) {
  fs::create_directory(at("p"));
  write(at("p/x"), "ours");
  write(at("p/thesis.tex"), "theirs");
  EXPECT_THAT(refusalOf([&] { OutputFolder(at("p"), true, {"x"}); }), testing::HasSubstr("thesis.tex"));
  EXPECT_EQ(read(at("p/thesis.tex")), "theirs");
}

/// As a killed program leaves it: unlocked, and older than one that was just created.
void abandon(const fs::path& temporary) {
  fs::last_write_time(temporary, fs::file_time_type::clock::now() - std::chrono::minutes(2));
}

TEST_F(Output, RemovesLeftoversOfTheSameTarget) {
  write(at(".part-abcdefgh-a.nrrd"), "half");
  fs::create_directory(at(".part-01234567-patient"));
  write(at(".part-01234567-patient/volume.vdb"), "half");
  abandon(at(".part-abcdefgh-a.nrrd"));
  abandon(at(".part-01234567-patient"));
  { OutputFile file(at("a.nrrd"), false); }
  { OutputFolder folder(at("patient"), false, {}); }
  EXPECT_EQ(entries(), 0);
}

TEST_F(Output, RestoresAFolderThatAKilledProgramSetAside) {
  fs::create_directory(at(".kept-patient"));
  write(at(".kept-patient/x"), "old");
  EXPECT_THAT(refusalOf([&] { OutputFolder(at("patient"), false, {"x"}); }), testing::HasSubstr("--force"));
  EXPECT_EQ(read(at("patient/x")), "old");
  fs::create_directory(at(".kept-patient"));  // killed a step later: its successor is in place
  { OutputFolder folder(at("patient"), true, {"x"}); }
  EXPECT_EQ(read(at("patient/x")), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(Output, KeepsTemporariesInUseOrOfOtherTargets) {
  OutputFile at_work(at("a.nrrd"), false);
  OutputFolder folder_at_work(at("patient"), false, {});
  abandon(at_work.temporaryPath());
  abandon(folder_at_work.temporaryPath());
  for (const char* other :
       {".part-abcdefgh-b.nrrd", ".part-abc-a.nrrd", ".part-ABCDEFGH-a.nrrd", "part-abcdefgh-a.nrrd"}) {
    write(at(other), "another's");
    abandon(at(other));
  }
  write(at(".part-zzzzzzzz-a.nrrd"), "just begun");
  { OutputFile again(at("a.nrrd"), false); }
  { OutputFolder again(at("patient"), false, {}); }
  EXPECT_EQ(entries(), 7);
}

TEST(TemporaryNames, AreRemovedFromMessages) {
  EXPECT_EQ(calibration::withoutTemporaryNames("image out/.part-q2dm741g-o.png: no room, .part-00000000-x"),
            "image out/o.png: no room, x");
  EXPECT_EQ(calibration::withoutTemporaryNames(".part-q2dm741g"), ".part-q2dm741g");
  EXPECT_EQ(calibration::withoutTemporaryNames(".part-q2dm741G-o .part-"), ".part-q2dm741G-o .part-");
}

}  // namespace
