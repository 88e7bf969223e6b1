#include "app/session/session_list.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "app/session/data_folder.h"
#include "app/session/recorder.h"
#include "app/session/session_error.h"
#include "app/session/session_folder.h"
#include "app/session/session_reader.h"
#include "app/session/session_writer.h"
#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

/// The data folder of this test, with sessions in it.
struct DataFolder {
  tests::ScratchFolder scratch;
  test::SmallBone bone;
  std::filesystem::path sessions;

  DataFolder() {
    setenv("XDG_DATA_HOME", std::filesystem::path(scratch.file("")).c_str(), 1);
    sessions = usualSessionFolder();
    makeDataFolder(sessions);
  }
  ~DataFolder() { unsetenv("XDG_DATA_HOME"); }

  /// Closed in order, or left as by a kill.
  std::string record(const std::string& name, const std::string& started_utc, std::uint64_t ticks, bool closed = true,
                     std::uint64_t lost = 0) {
    SessionStart start = bone.start();
    start.started_utc = started_utc;
    const std::string path = (sessions / name).string();
    {
      SessionWriter writer(path, false, start);
      for (std::uint64_t first = 0; first < ticks; first += 50)
        writer.write({{}, test::imaginedTicks(first, std::min<std::uint64_t>(50, ticks - first)), {}});
      if (closed) writer.seal(lost);
    }
    return path;
  }
};

TEST(SessionList, GivesDateCaseLengthAndVerdictNewestFirst) {
  DataFolder at;
  at.record("a.molar", "2026-11-20T08:00:00Z", 1000);
  at.record("b.molar", "2026-11-22T08:00:00Z", 250, false);
  at.record("c.molar", "2026-11-21T08:00:00Z", 500, true, 7);
  test::writeBytes((at.sessions / "d.molar").string(), "no session at all");
  test::writeBytes((at.sessions / "notes.txt").string(), "not listed");
  std::vector<SessionListing> list = listSessions(at.sessions);
  ASSERT_EQ(list.size(), 4u);
  std::erase_if(list, [](const SessionListing& one) { return !one.isReadable(); });
  ASSERT_EQ(list.size(), 3u);
  EXPECT_TRUE(list[0].path.ends_with("b.molar"));
  EXPECT_EQ(list[0].verdict, SessionVerdict::killed);
  EXPECT_NEAR(list[0].length_s, 0.25, 1e-9);
  EXPECT_EQ(list[1].verdict, SessionVerdict::gaps);
  EXPECT_EQ(list[1].remark, "7 ticks lost");
  EXPECT_EQ(list[2].verdict, SessionVerdict::complete);
  EXPECT_NEAR(list[2].length_s, 1.0, 1e-9);
  EXPECT_EQ(list[2].case_title, "built-in patient, right");
  EXPECT_EQ(list[2].unix_s, 1'795'161'600) << "2026-11-20, 8 o'clock UTC";
  EXPECT_TRUE(listSessions(at.sessions / "missing").empty());
}

TEST(SessionList, NamesDamageAndFindsAnyByteWhenAsked) {
  DataFolder at;
  const std::string path = at.record("a.molar", "2026-11-20T08:00:00Z", 1000);
  std::string bytes = test::bytesOf(path);
  bytes[bytes.size() - 3] ^= 1;
  test::writeBytes(path, bytes);
  EXPECT_EQ(listSessions(at.sessions).at(0).verdict, SessionVerdict::complete) << "its ticks were not read";
  const SessionListing checked = listSessions(at.sessions, true).at(0);
  EXPECT_EQ(checked.verdict, SessionVerdict::damaged);
  EXPECT_FALSE(checked.remark.empty());
  test::writeBytes(path, bytes.substr(0, 3000));
  EXPECT_EQ(listSessions(at.sessions).at(0).verdict, SessionVerdict::damaged);
  EXPECT_FALSE(listSessions(at.sessions).at(0).remark.empty());
}

TEST(SessionList, ShowsWhatIsBeingRecordedAndDoesNotCallItTheLast) {
  DataFolder at;
  const std::string old = at.record("a.molar", "2026-11-20T08:00:00Z", 100);
  haptics::TickLog log;
  Recorder recorder((at.sessions / "b.molar").string(), false, at.bone.start(), log, DrainMode::by_hand);
  for (const haptics::Tick& tick : test::imaginedTicks(0, 100)) log.push(tick);
  recorder.drain();
  const std::vector<SessionListing> list = listSessions(at.sessions);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].verdict, SessionVerdict::recording);
  EXPECT_EQ(sessionNamed("last"), old);
  recorder.stop();
  EXPECT_EQ(sessionNamed("last"), (at.sessions / "b.molar").string());
}

TEST(SessionList, AtMostThoseWrittenLast) {
  DataFolder at;
  using namespace std::chrono_literals;
  const auto now = std::filesystem::file_time_type::clock::now();
  for (int n = 0; n < 5; ++n) {
    const std::string day = "2026-11-2" + std::to_string(n) + "T08:00:00Z";
    std::filesystem::last_write_time(at.record(std::to_string(n) + ".molar", day, 10), now + n * 1h);
  }
  const std::vector<SessionListing> list = listSessions(at.sessions, false, 2);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].path, (at.sessions / "4.molar").string());
  EXPECT_EQ(list[1].path, (at.sessions / "3.molar").string());
}

TEST(SessionFolder, LastIsTheOneWrittenLastAndOtherTextIsAName) {
  DataFolder at;
  EXPECT_EQ(sessionNamed("some/file.molar"), "some/file.molar");
  EXPECT_THROW(sessionNamed("last"), SessionError);
  const std::string one = at.record("z.molar", "2026-11-20T08:00:00Z", 100);
  const std::string two = at.record("a.molar", "2026-11-20T08:00:00Z", 100, false);
  using namespace std::chrono_literals;
  std::filesystem::last_write_time(one, lastWritten(two) + 1s);
  EXPECT_EQ(sessionNamed("last"), one);
  std::filesystem::last_write_time(one, lastWritten(two) - 1h);
  EXPECT_EQ(sessionNamed("last"), two) << "killed, but newer";
}

TEST(SessionFolder, NamesHoldDateTimeAndToothAndAreFree) {
  DataFolder at;
  setenv("TZ", "UTC", 1);
  tzset();
  const std::string first = newSessionPath(at.sessions, 1'795'161'600, 48);
  EXPECT_EQ(first, (at.sessions / "2026-11-20-080000-tooth-48.molar").string());
  EXPECT_EQ(newSessionPath(at.sessions, 1'795'161'600, 0), (at.sessions / "2026-11-20-080000-jaw.molar").string());
  test::writeBytes(first, "taken");
  EXPECT_EQ(newSessionPath(at.sessions, 1'795'161'600, 48),
            (at.sessions / "2026-11-20-080000-tooth-48-2.molar").string());
}

TEST(DataFolder, PicturesHaveFreeNamesOfDateTimeAndTooth) {
  DataFolder at;
  setenv("TZ", "UTC", 1);
  tzset();
  const std::filesystem::path folder = usualPictureFolder();
  EXPECT_EQ(folder.filename(), "pictures");
  EXPECT_EQ(folder.parent_path(), at.sessions.parent_path());
  makeDataFolder(folder);
  const std::string first = newPicturePath(folder, 1'795'161'600, 48);
  EXPECT_EQ(first, (folder / "2026-11-20-080000-tooth-48.png").string());
  test::writeBytes(first, "taken");
  EXPECT_EQ(newPicturePath(folder, 1'795'161'600, 48), (folder / "2026-11-20-080000-tooth-48-2.png").string());
}

TEST(SessionSetup, IsStoredWithTheSession) {
  DataFolder at;
  SessionStart start = at.bone.start();
  start.started_utc = "2026-11-20T08:00:00Z";
  assets::JawParameters jaw;
  jaw.right_side = false;
  jaw.depth_mm = 5.25;
  jaw.seed = 1234567890123;
  jaw.opening_mm = 28.5;
  start.setup.built_in = jaw;
  start.setup.tray = {{{haptics::ShapeKind::sphere, 1.5, 0.0}, {0.9, 25.0}},
                      {{haptics::ShapeKind::capsule, 0.8, 4.125}, {0.5, 20.0}},
                      {{haptics::ShapeKind::revolved, 0.8, 8.0, assets::BurProfile::flame}, {0.5, 20.0}}};
  start.setup.down_P = glm::dvec3(0.0, 0.6, -0.8);
  start.setup.former = FormerSession{"2026-11-19-tooth-48.molar", 61.25, 0xfedcba9876543210u};
  const std::string path = (at.sessions / "a.molar").string();
  SessionWriter(path, false, start).write({{}, test::imaginedTicks(0, 10), {}});
  const StoredStart stored = SessionReader(path).about();
  ASSERT_TRUE(stored.setup.built_in);
  EXPECT_FALSE(stored.setup.built_in->right_side);
  EXPECT_EQ(stored.setup.built_in->depth_mm, 5.25);
  EXPECT_EQ(stored.setup.built_in->seed, jaw.seed);
  EXPECT_EQ(stored.setup.built_in->opening_mm, 28.5);
  EXPECT_EQ(stored.setup.tray, start.setup.tray);
  EXPECT_EQ(stored.setup.down_P, start.setup.down_P);
  ASSERT_TRUE(stored.setup.former);
  EXPECT_EQ(stored.setup.former->file, "2026-11-19-tooth-48.molar");
  EXPECT_EQ(stored.setup.former->bone_digest, 0xfedcba9876543210u);
  EXPECT_EQ(listSessions(at.sessions).at(0).continues, "2026-11-19-tooth-48.molar");
}

}  // namespace
}  // namespace app
