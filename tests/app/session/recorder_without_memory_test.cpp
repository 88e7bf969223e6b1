// The recorder where memory is out: this program's own allocator says so when it is told to.
#include <gtest/gtest.h>

#include "app/session/recorder.h"
#include "app/session/replay.h"
#include "tests/app/session/memory_limit.h"
#include "tests/app/session/small_session.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using test::memory_is_out;

struct Recorded {
  tests::ScratchFolder folder;
  std::string path = folder.file("s.molar");
  test::SmallBone bone;
  haptics::TickLog log;
  Recorder recorder{path, false, bone.start(), log, DrainMode::by_hand};
  std::uint64_t made = 0;

  void push(std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n) log.push(test::imaginedTick(made++));
  }
  void expectEndedAfter(std::uint64_t ticks) {
    EXPECT_TRUE(recorder.trouble().has_value());
    const RecordingSummary summary = recorder.stop();
    EXPECT_EQ(summary.ticks, ticks);
    EXPECT_EQ(summary.lost, made - ticks);
    EXPECT_FALSE(summary.isWhole());
  }
};

TEST(RecorderWithoutMemory, EndsTheRecordingAndNotTheProgram) {
  Recorded at;
  at.push(100);
  at.recorder.drain();
  at.push(50);
  memory_is_out = true;
  at.recorder.drain();
  memory_is_out = false;
  at.push(30);
  at.recorder.drain();
  at.expectEndedAfter(100);
}

TEST(RecorderWithoutMemory, EndsWhereACommandCanNotBeKept) {
  Recorded at;
  at.push(100);
  at.recorder.drain();
  memory_is_out = true;
  at.recorder.command({});
  memory_is_out = false;
  at.push(50);
  at.recorder.drain();
  at.expectEndedAfter(100);
}

TEST(RecorderWithoutMemory, LeavesWhatWasWrittenReadable) {
  const tests::ScratchFolder folder;
  {
    const test::SmallBone bone;
    haptics::TickLog log;
    Recorder recorder(folder.file("s.molar"), false, bone.start(), log, DrainMode::by_hand);
    for (std::uint64_t n = 0; n < 100; ++n) log.push(test::imaginedTick(n));
    recorder.drain();
    log.push(test::imaginedTick(100));
    memory_is_out = true;
    recorder.drain();
    memory_is_out = false;
  }
  EXPECT_EQ(verify(folder.file("s.molar")).damage, std::nullopt);
  EXPECT_EQ(verify(folder.file("s.molar")).ticks, 100u);
}

}  // namespace
}  // namespace app
