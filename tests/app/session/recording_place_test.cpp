#include "app/session/recording_place.h"

#include <sys/stat.h>

#include <filesystem>

#include <gmock/gmock.h>

#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "tests/app/session/small_session.h"

namespace app {
namespace {

using test::bytesOf;
using test::imaginedTicks;
using test::writeBytes;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::string refusalOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const SessionError& refusal) {
    return refusal.what();
  }
  return "";
}

struct Place {
  test::ScratchFolder folder;
  test::SmallBone bone;
  std::string path = folder.file("s.molar");

  void record(bool overwrite, std::uint64_t ticks, bool closed = true) const {
    SessionWriter writer(path, overwrite, bone.start());
    writer.write({{}, imaginedTicks(0, ticks), {}});
    if (closed) writer.seal(0);
  }
  std::uint64_t ticks(const std::string& of) const { return verify(of).ticks; }
  /// As a program killed now leaves it.
  void leave(const std::string& live, const std::string& as) const {
    for (const std::string& file : filesOf(live))
      if (std::filesystem::exists(file)) std::filesystem::copy_file(file, as + file.substr(live.size()));
  }
};

TEST(RecordingPlace, HasNoNameBeforeItsFirstTick) {
  const Place at;
  {
    SessionWriter writer(at.path, false, at.bone.start());
    EXPECT_FALSE(std::filesystem::exists(at.path));
    writer.write({{}, imaginedTicks(0, 3), {}});
    EXPECT_TRUE(std::filesystem::exists(at.path));
  }
  EXPECT_EQ(at.ticks(at.path), 3u);
}

TEST(RecordingPlace, LeavesNothingWhereNothingWasRecorded) {
  const Place at;
  { SessionWriter writer(at.path, false, at.bone.start()); }
  EXPECT_TRUE(at.folder.names().empty());
}

TEST(RecordingPlace, IsNotBlockedByAProgramKilledBeforeItsFirstTick) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    at.leave(at.folder.file("live.new"), at.path + ".new");
  }
  at.record(false, 5);
  EXPECT_THAT(at.folder.names(), UnorderedElementsAre("s.molar"));
  EXPECT_EQ(at.ticks(at.path), 5u);
}

TEST(RecordingPlace, KeepsTheOldFileUntilTheNewOneIsWhole) {
  const Place at;
  at.record(false, 50);
  const std::string old = bytesOf(at.path);
  {
    SessionWriter writer(at.path, true, at.bone.start());
    EXPECT_EQ(bytesOf(at.path), old);
    writer.write({{}, imaginedTicks(0, 7), {}});
    EXPECT_EQ(bytesOf(at.path), old);
    // Killed now: both are there.
    at.leave(at.path + ".new", at.folder.file("killed.molar"));
    EXPECT_EQ(at.ticks(at.folder.file("killed.molar")), 7u);
    writer.seal(0);
  }
  EXPECT_EQ(at.ticks(at.path), 7u);
  EXPECT_FALSE(std::filesystem::exists(at.path + ".new"));
}

TEST(RecordingPlace, KeepsWhatAKilledReplacementRecorded) {
  const Place at;
  at.record(false, 50);
  {
    SessionWriter writer(at.path, true, at.bone.start());
    writer.write({{}, imaginedTicks(0, 7), {}});
    at.leave(at.path + ".new", at.folder.file("kept"));
  }
  std::filesystem::remove(at.path + ".new");
  at.leave(at.folder.file("kept"), at.path + ".new");
  at.record(true, 9);
  EXPECT_EQ(at.ticks(at.path), 9u);
  EXPECT_EQ(at.ticks(at.path + ".new"), 7u) << "evidence of another program";
}

TEST(RecordingPlace, TakesTheLogOfAKilledOneAwayWithIt) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    writer.write({{}, imaginedTicks(0, 50), {}});
    at.leave(at.folder.file("live"), at.path);
  }
  ASSERT_TRUE(std::filesystem::exists(at.path + "-wal"));
  at.record(true, 9);
  EXPECT_FALSE(std::filesystem::exists(at.path + "-wal"));
  EXPECT_EQ(at.ticks(at.path), 9u);
}

TEST(RecordingPlace, OfARunningRecordingIsNobodyElses) {
  const Place at;
  SessionWriter running(at.path, false, at.bone.start());
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  running.write({{}, imaginedTicks(0, 7), {}});
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  EXPECT_THAT(refusalOf([&] { at.record(false, 5); }), HasSubstr("exists already"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader(at.path); }), HasSubstr("is being recorded just now"));
  running.seal(0);
  EXPECT_EQ(at.ticks(at.path), 7u);
}

TEST(RecordingPlace, ThatIsBeingReplacedIsNobodyElses) {
  const Place at;
  at.record(false, 50);
  SessionWriter running(at.path, true, at.bone.start());
  running.write({{}, imaginedTicks(0, 7), {}});
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  running.seal(0);
  EXPECT_EQ(at.ticks(at.path), 7u);
}

TEST(RecordingPlace, IsAPlainFile) {
  const Place at;
  ASSERT_EQ(::mkfifo(at.path.c_str(), 0600), 0);
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { verify(at.path); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader("/dev/null"); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader("/tmp"); }), HasSubstr("not a plain file"));
}

TEST(RecordingPlace, FollowsALinkToWhatItStandsFor) {
  const Place at;
  at.record(false, 50);
  std::filesystem::create_symlink(at.path, at.folder.file("link"));
  SessionWriter(at.folder.file("link"), true, at.bone.start()).seal(0);
  EXPECT_TRUE(std::filesystem::is_symlink(at.folder.file("link")));
  EXPECT_EQ(at.ticks(at.path), 0u);
}

/// What a killed program leaves, and a copy of its first file alone.
TEST(KilledRecording, WithoutItsLogIsNamedSo) {
  const Place at;
  const std::string copy = at.folder.file("copy.molar");
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    writer.write({{}, imaginedTicks(0, 50), {}});
    std::filesystem::copy_file(at.folder.file("live"), copy);
  }
  const ReplayReport report = verify(copy);
  EXPECT_FALSE(report.verified());
  EXPECT_EQ(report.damage, std::nullopt);
  EXPECT_THAT(report.line(), HasSubstr("copy.molar-wal is not beside it: copy both files"));
  EXPECT_THAT(at.folder.names(), UnorderedElementsAre("copy.molar", "live"));
}

TEST(KilledRecording, IsReadWithoutWritingToItsFolder) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    writer.write({{}, imaginedTicks(0, 50), {}});
    at.leave(at.folder.file("live"), at.path);
  }
  const std::string file = bytesOf(at.path), log = bytesOf(at.path + "-wal");
  EXPECT_EQ(at.ticks(at.path), 50u);
  EXPECT_EQ(bytesOf(at.path), file);
  EXPECT_EQ(bytesOf(at.path + "-wal"), log);
  EXPECT_THAT(at.folder.names(), UnorderedElementsAre("live", "s.molar", "s.molar-wal"));
}

}  // namespace
}  // namespace app
