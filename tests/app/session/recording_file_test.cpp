#include "app/session/recording_file.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <filesystem>
#include <random>

#include <gmock/gmock.h>

#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "tests/app/session/small_session.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using test::bytesOf;
using test::imaginedTicks;
using test::writeBytes;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::string refusalOf(const std::function<void()>& work) {
  return tests::refusalOf<SessionError>([&] { work(); });
}

struct Place {
  tests::ScratchFolder folder;
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
    for (const std::string& file : sessionFiles(live))
      if (std::filesystem::exists(file)) std::filesystem::copy_file(file, as + file.substr(live.size()));
  }
};

TEST(RecordingFile, HasNoNameBeforeItsFirstTick) {
  const Place at;
  {
    SessionWriter writer(at.path, false, at.bone.start());
    EXPECT_FALSE(std::filesystem::exists(at.path));
    writer.write({{}, imaginedTicks(0, 3), {}});
    EXPECT_TRUE(std::filesystem::exists(at.path));
  }
  EXPECT_EQ(at.ticks(at.path), 3u);
}

TEST(RecordingFile, LeavesNothingWhereNothingWasRecorded) {
  const Place at;
  { SessionWriter writer(at.path, false, at.bone.start()); }
  EXPECT_TRUE(at.folder.names().empty());
}

TEST(RecordingFile, IsNotBlockedByAProgramKilledBeforeItsFirstTick) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    at.leave(at.folder.file("live.new"), at.path + ".new");
  }
  at.record(false, 5);
  EXPECT_THAT(at.folder.names(), UnorderedElementsAre("s.molar"));
  EXPECT_EQ(at.ticks(at.path), 5u);
}

/// From here on the system kills this process where it would let a file grow past `bytes`.
void beKilledPast(rlim_t bytes) {
  ::signal(SIGXFSZ, SIG_DFL);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

TEST(RecordingFile, IsNotBlockedByAProgramKilledWhileItWroteTheStart) {
  // Larger than what SQLite keeps in memory, so that pages reach the file out of order.
  assets::VolumeGrid grid{{200, 200, 100}, 0.2, {0.0, 0.0, 0.0}};
  std::vector<std::uint8_t> solid(grid.voxelCount());
  std::mt19937 random(1);
  for (std::uint8_t& value : solid) value = static_cast<std::uint8_t>(random());
  for (const rlim_t bytes : {0, 1, 512, 4096, 5000, 9000, 100'000, 3'000'000, 4'000'000}) {
    const Place at;
    SessionStart start = at.bone.start();
    start.grid = grid, start.solid = solid, start.label = {};
    EXPECT_EXIT((beKilledPast(bytes), SessionWriter(at.path, false, start)), testing::KilledBySignal(SIGXFSZ), "");
    EXPECT_FALSE(std::filesystem::exists(at.path));
    at.record(false, 5);
    EXPECT_THAT(at.folder.names(), UnorderedElementsAre("s.molar")) << bytes;
  }
}

TEST(RecordingFile, IsNotBlockedByAProgramKilledWhileItTookItsName) {
  int took_it = 0;
  for (rlim_t bytes = 0; bytes < 80'000; bytes += bytes < 1024 ? 256 : 8192) {
    const Place at;
    const auto beKilledWriting = [&] {
      SessionWriter writer(at.path, false, at.bone.start());
      beKilledPast(bytes);
      for (std::uint64_t n = 0;; ++n) writer.write({{}, imaginedTicks(50 * n, 50), {}});
    };
    EXPECT_EXIT(beKilledWriting(), testing::KilledBySignal(SIGXFSZ), "");
    // What bears the name holds ticks.
    if (!std::filesystem::exists(at.path)) continue;
    ++took_it;
    EXPECT_GT(at.ticks(at.path), 0u) << bytes;
  }
  EXPECT_GT(took_it, 0);
}

TEST(RecordingFile, ThatAnotherProgramReplacesEndsTheRecordingAndStaysAsItIs) {
  const Place at;
  const std::string csv = at.folder.file("forces.csv");
  for (const bool between_writes : {true, false}) {
    {
      SessionWriter writer(at.path, false, at.bone.start());
      writer.write({{}, imaginedTicks(0, 50), {}});
      writeBytes(csv, "t_s,fx_N\n");
      std::filesystem::rename(csv, at.path);
      const auto end = [&] { between_writes ? writer.write({{}, imaginedTicks(50, 50), {}}) : writer.seal(0); };
      EXPECT_THAT(refusalOf(end), HasSubstr("was replaced or removed by another program"));
    }
    EXPECT_EQ(bytesOf(at.path), "t_s,fx_N\n");
    EXPECT_THAT(at.folder.names(), UnorderedElementsAre("s.molar"));
    std::filesystem::remove(at.path);
  }
}

TEST(RecordingFile, IsBesideItsNameWhereAnotherProgramTookThatMeanwhile) {
  const Place at;
  {
    SessionWriter writer(at.path, false, at.bone.start());
    writeBytes(at.path, "somebody's");
    EXPECT_THAT(refusalOf([&] { writer.write({{}, imaginedTicks(0, 50), {}}); }), HasSubstr("it is " + writer.file()));
    EXPECT_EQ(writer.ticks(), 50u);
  }
  EXPECT_EQ(bytesOf(at.path), "somebody's");
  EXPECT_EQ(at.ticks(at.path + ".new"), 50u);
}

TEST(RecordingFile, KeepsTheOldFileUntilTheNewOneIsWhole) {
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

TEST(RecordingFile, KeepsWhatAKilledReplacementRecorded) {
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

TEST(RecordingFile, TakesTheLogOfAKilledOneAwayWithIt) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    for (std::uint64_t n = 0; n < 2; ++n) writer.write({{}, imaginedTicks(25 * n, 25), {}});
    at.leave(at.folder.file("live"), at.path);
  }
  ASSERT_TRUE(std::filesystem::exists(at.path + "-wal"));
  at.record(true, 9);
  EXPECT_FALSE(std::filesystem::exists(at.path + "-wal"));
  EXPECT_EQ(at.ticks(at.path), 9u);
}

TEST(RecordingFile, OfARunningRecordingIsNobodyElses) {
  const Place at;
  SessionWriter running(at.path, false, at.bone.start());
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  running.write({{}, imaginedTicks(0, 7), {}});
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  EXPECT_THAT(refusalOf([&] { at.record(false, 5); }), HasSubstr("already exists"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader(at.path); }), HasSubstr("is being recorded: "));
  running.seal(0);
  EXPECT_EQ(at.ticks(at.path), 7u);
}

TEST(RecordingFile, ThatIsBeingReplacedIsNobodyElses) {
  const Place at;
  at.record(false, 50);
  SessionWriter running(at.path, true, at.bone.start());
  running.write({{}, imaginedTicks(0, 7), {}});
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("another program is recording to it"));
  running.seal(0);
  EXPECT_EQ(at.ticks(at.path), 7u);
}

TEST(RecordingFile, IsAPlainFile) {
  const Place at;
  ASSERT_EQ(::mkfifo(at.path.c_str(), 0600), 0);
  EXPECT_THAT(refusalOf([&] { at.record(true, 5); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { verify(at.path); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader("/dev/null"); }), HasSubstr("not a plain file"));
  EXPECT_THAT(refusalOf([&] { SessionReader reader("/tmp"); }), HasSubstr("not a plain file"));
}

TEST(RecordingFile, FollowsALinkToWhatItStandsFor) {
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
  EXPECT_THAT(report.line(), HasSubstr("copy.molar-wal is not next to it: copy both files"));
  EXPECT_THAT(at.folder.names(), UnorderedElementsAre("copy.molar", "live"));
}

TEST(KilledRecording, WithoutItsLogHasNoBoneThatWasLeft) {
  const Place at;
  const std::string copy = at.folder.file("copy.molar");
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    for (std::uint64_t n = 0; n < 10; ++n) writer.write({{}, imaginedTicks(50 * n, 50), {}});
    std::filesystem::copy_file(at.folder.file("live"), copy);
  }
  const std::string refusal = "its log " + copy + "-wal is not next to it: copy both files";
  EXPECT_THAT(refusalOf([&] { boneAtTime(copy, std::nullopt); }), HasSubstr(refusal));
  EXPECT_THAT(refusalOf([&] { boneAtTime(copy, 0.4); }), HasSubstr(refusal));
}

TEST(KilledRecording, IsReadThroughALinkWithItsLog) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    for (std::uint64_t n = 0; n < 4; ++n) writer.write({{}, imaginedTicks(50 * n, 50), {}});
    at.leave(at.folder.file("live"), at.path);
  }
  std::filesystem::create_symlink("s.molar", at.folder.file("link"));
  std::filesystem::create_symlink("link", at.folder.file("link_to_link"));
  EXPECT_EQ(at.ticks(at.folder.file("link_to_link")), 200u);
}

TEST(ClosedRecording, IsNotReadAsWhatAnothersLogSays) {
  const Place at;
  const std::string good = at.folder.file("good.molar");
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    for (std::uint64_t n = 0; n < 4; ++n) writer.write({{}, imaginedTicks(50 * n, 50), {}});
    at.leave(at.folder.file("live"), at.path);
  }
  {
    SessionWriter writer(good, false, at.bone.start());
    writer.write({{}, imaginedTicks(0, 7), {}});
    writer.seal(0);
  }
  std::filesystem::copy_file(good, at.path, std::filesystem::copy_options::overwrite_existing);
  ASSERT_TRUE(std::filesystem::exists(at.path + "-wal"));
  EXPECT_EQ(at.ticks(at.path), 7u);
  EXPECT_TRUE(verify(at.path).closed);
  EXPECT_EQ(verify(at.path).damage, std::nullopt);
}

TEST(KilledRecording, IsReadWithoutWritingToItsFolder) {
  const Place at;
  {
    SessionWriter writer(at.folder.file("live"), false, at.bone.start());
    for (std::uint64_t n = 0; n < 2; ++n) writer.write({{}, imaginedTicks(25 * n, 25), {}});
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
