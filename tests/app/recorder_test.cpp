#include "app/session/recorder.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "app/session/packing.h"
#include "app/session/replay.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "tests/app/small_session.h"

namespace app {
namespace {

using namespace std::chrono_literals;
using test::imaginedTick;

std::vector<haptics::Tick> allTicks(const std::string& path) {
  SessionReader session(path);
  std::vector<haptics::Tick> ticks;
  for (auto block = session.nextTicks(); !block.empty(); block = session.nextTicks()) {
    ticks.insert(ticks.end(), block.begin(), block.end());
  }
  return ticks;
}

TEST(Recorder, WritesEveryTickAndSealsTheFile) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    log.push(imaginedTick(i));
    if (i % 500 == 0) std::this_thread::sleep_for(15ms);
  }
  const RecordingSummary summary = recorder.stop();
  EXPECT_EQ(summary.ticks, 3000u);
  EXPECT_EQ(summary.lost, 0u);
  EXPECT_EQ(summary.trouble, std::nullopt);
  EXPECT_EQ(recorder.stop().ticks, 3000u);

  SessionReader session(folder.file("s.molar"));
  EXPECT_TRUE(session.closed());
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_EQ(packTicks(allTicks(folder.file("s.molar"))), packTicks(test::imaginedTicks(0, 3000)));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.molar"});
}

TEST(Recorder, NotesTheTickFromWhichACommandIsInForce) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  haptics::Command command;
  for (std::uint64_t i = 0; i < 100; ++i) log.push(imaginedTick(i, 1));
  // Serial 2 is overtaken by 3 before the servo reads it.
  for (std::uint64_t serial : {2, 3, 4}) {
    command.serial = serial;
    command.tool.head.radius_mm = static_cast<double>(serial);
    recorder.command(command);
  }
  for (std::uint64_t i = 100; i < 200; ++i) log.push(imaginedTick(i, i < 160 ? 3 : 4));
  recorder.stop();

  const auto commands = SessionReader(folder.file("s.molar")).commands();
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(commands[0].first_tick, 0u);
  EXPECT_EQ(commands[1].command.tool.head.radius_mm, 3.0);
  EXPECT_EQ(commands[1].first_tick, 100u);
  EXPECT_EQ(commands[2].command.serial, 4u);
  EXPECT_EQ(commands[2].first_tick, 160u);
}

TEST(Recorder, KeepsEventsAndPicturesAtTheirTick) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  for (std::uint64_t i = 0; i < 60; ++i) log.push(imaginedTick(i));
  std::this_thread::sleep_for(150ms);
  recorder.event("note", "the canal is near");
  recorder.picture("left.png", {9, 8, 7});
  recorder.stop();
  SessionReader session(folder.file("s.molar"));
  ASSERT_EQ(session.events().size(), 1u);
  EXPECT_EQ(session.events()[0].text, "the canal is near");
  EXPECT_EQ(session.events()[0].tick, 60u);
  EXPECT_EQ(session.pictures()[0].name, "left.png");
}

TEST(Recorder, CountsTicksTheLogHadNoRoomFor) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log(16);
  Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
  std::this_thread::sleep_for(50ms);
  for (std::uint64_t i = 0; i < 4000; ++i) log.push(imaginedTick(i));
  const RecordingSummary summary = recorder.stop();
  EXPECT_GT(summary.lost, 0u);
  EXPECT_EQ(summary.ticks + summary.lost, 4000u);
  EXPECT_EQ(SessionReader(folder.file("s.molar")).lost(), summary.lost);
}

TEST(Recorder, OverwritesNothingUnasked) {
  const test::ScratchFolder folder;
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
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log(100'000);
  RecordingSummary summary;
  {
    const FullDisk full(400'000);
    Recorder recorder(folder.file("s.molar"), false, bone.start(), log);
    for (std::uint64_t i = 0; i < 100 * 200; ++i) {
      log.push(imaginedTick(i));
      if (i % 200 == 0) std::this_thread::sleep_for(5ms);
    }
    summary = recorder.stop();
  }
  ASSERT_TRUE(summary.trouble.has_value());
  EXPECT_EQ(summary.trouble->find('\n'), std::string::npos);
  EXPECT_GT(summary.ticks, 0u);
  EXPECT_EQ(summary.ticks + summary.lost, 20'000u);

  SessionReader session(folder.file("s.molar"));
  EXPECT_EQ(session.damage(), std::nullopt);
  EXPECT_FALSE(session.closed());
  EXPECT_EQ(packTicks(allTicks(folder.file("s.molar"))), packTicks(test::imaginedTicks(0, summary.ticks)));
}

TEST(Recorder, SaysOneLineWhenTheDiskIsFullFromTheStart) {
  const test::ScratchFolder folder;
  const test::SmallBone bone;
  haptics::TickLog log;
  const FullDisk full(100);
  EXPECT_THROW(Recorder(folder.file("s.molar"), false, bone.start(), log), SessionError);
  EXPECT_TRUE(folder.names().empty());
}

struct Progress {
  std::uint64_t ticks = 0, longest_pause_us = 0;
};

Progress readProgress(const std::string& path) {
  const std::string bytes = test::bytesOf(path);
  Progress progress;
  if (bytes.size() == sizeof progress) std::memcpy(&progress, bytes.data(), sizeof progress);
  return progress;
}

TEST(Recorder, LosesAtMostAHundredMillisecondsToAKill) {
  const test::ScratchFolder folder;
  std::mt19937 random(3);
  int judged = 0;
  for (int kill = 0; kill < 10; ++kill) {
    const std::string session = folder.file(std::to_string(kill) + ".molar"), progress = session + ".progress";
    test::writeBytes(progress, std::string(16, '\0'));
    std::string program = MOLAR_RECORD_UNTIL_KILLED;
    std::string arguments[] = {program, session, progress};
    char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
    pid_t child = 0;
    ASSERT_EQ(::posix_spawn(&child, program.c_str(), nullptr, nullptr, argv, environ), 0);
    for (int wait = 0; wait < 2000 && readProgress(progress).ticks < 50; ++wait) std::this_thread::sleep_for(5ms);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 400'000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the recording ended by itself";

    const ReplayReport report = verify(session);
    EXPECT_TRUE(report.verified()) << report.line();
    EXPECT_FALSE(report.closed);
    const Progress made = readProgress(progress);
    // A machine too busy to run the child's 1 kHz loop says nothing about the recorder.
    if (made.longest_pause_us > 40'000) continue;
    ++judged;
    EXPECT_LE(made.ticks - std::min(made.ticks, report.ticks), 100u) << made.ticks << " ticks made";
  }
  if (judged == 0) GTEST_SKIP() << "the machine is too busy to keep 1 kHz: the loss to a kill was not judged";
}

}  // namespace
}  // namespace app
