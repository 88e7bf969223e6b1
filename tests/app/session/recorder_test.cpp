#include "app/session/recorder.h"

#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "app/session/tick_columns.h"
#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using test::imaginedTick;

std::vector<haptics::Tick> allTicks(const std::string& path) {
  SessionReader session(path);
  std::vector<haptics::Tick> ticks;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    ticks.insert(ticks.end(), block.ticks.begin(), block.ticks.end());
  return ticks;
}

/// A recorder that is drained when the test says so.
struct ByHand {
  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder;
  std::uint64_t made = 0;

  explicit ByHand(std::size_t room = 10'000, bool overwrite = false)
      : log(room), recorder(path, overwrite, bone.start(), log, DrainMode::by_hand) {}
  void push(std::uint64_t count, std::uint64_t serial = 1) {
    for (std::uint64_t n = 0; n < count; ++n) log.push(imaginedTick(made++, serial));
  }
};

TEST(Recorder, WithoutATickLeavesWhatWasThere) {
  ByHand refused;
  refused.recorder.event("device", "refused at its start");
  const RecordingSummary nothing = refused.recorder.stop();
  EXPECT_EQ(nothing.trouble, "the recording ended early: no tick came");
  EXPECT_FALSE(nothing.isWhole());
  EXPECT_FALSE(std::filesystem::exists(refused.path));
}

TEST(Recorder, WritesEveryTickAndSealsTheFile) {
  ByHand at;
  for (int part = 0; part < 60; ++part) {
    at.push(50);
    at.recorder.drain();
  }
  at.push(7);
  const RecordingSummary summary = at.recorder.stop();
  EXPECT_EQ(summary.ticks, 3007u);
  EXPECT_TRUE(summary.isWhole());
  EXPECT_EQ(at.recorder.stop().ticks, 3007u);

  SessionReader session(at.path);
  EXPECT_TRUE(session.closed());
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_EQ(packTicks(allTicks(at.path)), packTicks(test::imaginedTicks(0, 3007)));
  EXPECT_EQ(at.folder.names(), std::vector<std::string>{"s.molar"});
}

TEST(Recorder, DrainsByItselfOnItsThread) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  log.push(imaginedTick(0));
  // The file has its name once the first tick is in it: nobody asked.
  while (!std::filesystem::exists(folder.file("s.molar"))) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(recorder.stop().ticks, 1u);
}

static_assert(kBetweenWrites <= 20ms, "what a kill may cost");

TEST(Recorder, TakesCommandsAndEventsWhileItsThreadDrains) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  haptics::Command command = bone.start().command;
  std::uint64_t told = 0;
  const std::size_t whole = log.room();
  // Until the thread has come a few times between the calls; never faster than it writes.
  for (std::size_t drains = 0, room = log.room(); drains < 5; room = log.room()) {
    ++command.serial;
    recorder.command(command);
    recorder.event("note", std::to_string(told));
    log.push(imaginedTick(told++, command.serial));
    EXPECT_EQ(recorder.trouble(), std::nullopt);
    do std::this_thread::sleep_for(100us);
    while (log.room() < whole / 2);
    if (log.room() > room) ++drains;
  }
  EXPECT_TRUE(recorder.stop().isWhole());
  SessionReader session(folder.file("s.molar"));
  EXPECT_EQ(session.events().size(), told);
  const auto commands = session.commands();
  ASSERT_EQ(commands.size(), told + 1);
  for (std::uint64_t n = 0; n < told; ++n) ASSERT_EQ(commands[n + 1].first_tick, n);
}

TEST(Recorder, SaysHowItsFileIsCalled) {
  ByHand at;
  EXPECT_EQ(at.recorder.temporaryFile(), std::nullopt);
  at.push(10);
  EXPECT_EQ(at.recorder.stop().file, at.path);
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder second(at.path, true, bone.start(), log, DrainMode::by_hand);
  EXPECT_EQ(second.temporaryFile(), at.path + ".new");
  log.push(imaginedTick(0));
  second.drain();
  std::filesystem::remove(at.path + ".new");
  log.push(imaginedTick(1));
  const RecordingSummary summary = second.stop();
  EXPECT_EQ(summary.file, at.path + ".new") << "the old one is still there";
  ASSERT_TRUE(summary.trouble.has_value());
  EXPECT_NE(summary.trouble->find(at.path + ".new: "), std::string::npos) << *summary.trouble;
}

TEST(Recorder, IsBegunBesideWhereALogAloneIsToGo) {
  const tests::ScratchFolder folder;
  test::writeBytes(folder.file("s.molar-wal"), "the rest of a killed session");
  test::writeBytes(folder.file("s.molar.new"), "somebody's");
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), true, bone.start(), log, DrainMode::by_hand);
  EXPECT_EQ(recorder.temporaryFile(), folder.file("s.molar.new2"));
}

TEST(Recorder, NotesTheTickFromWhichACommandIsInForce) {
  ByHand at;
  haptics::Command command;
  at.push(100);
  // Serial 2 is overtaken by 3 before the servo reads it.
  for (std::uint64_t serial : {2, 3, 4}) {
    command.serial = serial;
    command.tool.head.radius_mm = static_cast<double>(serial);
    at.recorder.command(command);
  }
  at.push(60, 3);
  at.push(40, 4);
  at.recorder.stop();

  const auto commands = SessionReader(at.path).commands();
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(commands[0].first_tick, 0u);
  EXPECT_EQ(commands[1].command.tool.head.radius_mm, 3.0);
  EXPECT_EQ(commands[1].first_tick, 100u);
  EXPECT_EQ(commands[2].command.serial, 4u);
  EXPECT_EQ(commands[2].first_tick, 160u);
}

TEST(Recorder, KeepsEventsAtTheirTick) {
  ByHand at;
  at.recorder.event("rig", "before the first tick");
  at.recorder.drain();
  EXPECT_FALSE(std::filesystem::exists(at.path)) << "nothing has happened yet";
  at.push(60);
  at.recorder.drain();
  at.recorder.event("note", "the canal is near");
  at.recorder.stop();
  const auto events = SessionReader(at.path).events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].tick, 0u);
  EXPECT_EQ(events[1].text, "the canal is near");
  EXPECT_EQ(events[1].tick, 60u);
}

TEST(Recorder, CountsTicksTheLogHadNoRoomFor) {
  ByHand at(16);
  at.push(40);
  at.recorder.drain();
  at.push(10);
  const RecordingSummary summary = at.recorder.stop();
  EXPECT_EQ(summary.ticks, 26u);
  EXPECT_EQ(summary.lost, 24u);
  EXPECT_FALSE(summary.isWhole());
  EXPECT_EQ(SessionReader(at.path).lost(), 24u);
}

TEST(Recorder, OverwritesNothingUnasked) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  test::writeBytes(folder.file("s.molar"), "precious");
  EXPECT_THROW(Recorder(folder.file("s.molar"), false, bone.start(), log), SessionError);
  EXPECT_EQ(test::bytesOf(folder.file("s.molar")), "precious");
}

/// No file of this process may grow past `bytes` while this stands: a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Recorder, OutlivesAFullDiskAndLeavesAValidFile) {
  ByHand at;
  RecordingSummary summary;
  {
    const FullDisk full(400'000);
    for (int part = 0; part < 100; ++part) {
      at.push(200);
      at.recorder.drain();
    }
    summary = at.recorder.stop();
  }
  ASSERT_TRUE(summary.trouble.has_value());
  EXPECT_EQ(summary.trouble->find('\n'), std::string::npos);
  EXPECT_GT(summary.ticks, 0u);
  EXPECT_EQ(summary.ticks + summary.lost, 20'000u);
  EXPECT_FALSE(summary.isWhole());

  // Still full: what can not be written is never called a changed file.
  const FullDisk full(0);
  EXPECT_THROW(SessionReader{at.path}, SessionError) << "the recorder that holds it still lives";
}

TEST(Recorder, LeavesAFileThatCanBeReadOnAFullDisk) {
  std::string path;
  std::optional<tests::ScratchFolder> folder;
  folder.emplace();
  path = folder->file("s.molar");
  RecordingSummary summary;
  {
    const test::SmallBone bone;
    haptics::TickLog log(100'000);
    const FullDisk full(400'000);
    Recorder recorder(path, false, bone.start(), log, DrainMode::by_hand);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      log.push(imaginedTick(i));
      if (i % 200 == 199) recorder.drain();
    }
    summary = recorder.stop();
  }
  ASSERT_GT(summary.ticks, 0u);
  ASSERT_LT(summary.ticks, 20'000u);
  const FullDisk full(0);
  SessionReader session(path);
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_FALSE(session.closed());
  EXPECT_EQ(packTicks(allTicks(path)), packTicks(test::imaginedTicks(0, summary.ticks)));
}

TEST(Recorder, SaysOneLineWhenTheDiskIsFullFromTheStart) {
  const tests::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  const FullDisk full(100);
  EXPECT_THROW(Recorder(folder.file("s.molar"), false, bone.start(), log), SessionError);
  EXPECT_TRUE(folder.names().empty());
}

struct Progress {
  std::uint64_t made = 0, written = 0;
};

Progress readProgress(const std::string& path) {
  const std::string bytes = test::bytesOf(path);
  Progress progress;
  if (bytes.size() == sizeof progress) std::memcpy(&progress, bytes.data(), sizeof progress);
  return progress;
}

TEST(Recorder, LosesToAKillWhatItHadNotWrittenYet) {
  const tests::ScratchFolder folder;
  std::mt19937 random(3);
  for (int kill = 0; kill < 10; ++kill) {
    const std::string session = folder.file(std::to_string(kill) + ".molar"), progress = session + ".progress";
    test::writeBytes(progress, std::string(16, '\0'));
    std::string program = MOLAR_RECORD_UNTIL_KILLED;
    std::string arguments[] = {program, session, progress};
    char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
    pid_t child = 0;
    ASSERT_EQ(::posix_spawn(&child, program.c_str(), nullptr, nullptr, argv, environ), 0);
    // Somewhere in its work, wherever the machine has it by then.
    const std::uint64_t until = 40 + random() % 1000;
    while (readProgress(progress).written < until && ::waitpid(child, nullptr, WNOHANG) == 0)
      std::this_thread::sleep_for(1ms);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the recording ended by itself";

    const ReplayReport report = verify(session);
    EXPECT_TRUE(report.verified()) << report.line();
    EXPECT_FALSE(report.closed);
    const Progress made = readProgress(progress);
    EXPECT_GE(report.ticks, made.written);
    EXPECT_LE(made.made - std::min(made.made, report.ticks), 20u) << made.made << " ticks made";
    EXPECT_FALSE(std::filesystem::exists(session + "-shm")) << "reading leaves nothing behind";
  }
}

}  // namespace
}  // namespace app
