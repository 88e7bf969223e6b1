// The victim of the kill test: a real servo carves a block of bone and is recorded, 20 ticks and a write at a time as
// in 20 ms, until somebody kills it. record_until_killed SESSION PROGRESS: PROGRESS is a file of two numbers that
// outlives the kill, kept up to date through shared memory: ticks logged so far, and ticks written.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>

#include "tests/app/session/real_session.h"

int main(int, char** argv) {
  const int file = ::open(argv[2], O_RDWR);
  void* memory = ::mmap(nullptr, 16, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) return 1;
  auto* progress = static_cast<std::atomic<std::uint64_t>*>(memory);

  const app::test::BoneBlock block;
  haptics::Bodies bone(block.grid, block.solid, block.label);
  haptics::Servo servo(bone);
  haptics::TickLog log;
  app::Recorder recorder(argv[1], false, block.start(), log, app::DrainMode::by_hand);
  haptics::Command command = block.start().command;

  for (std::uint64_t index = 0;; ++index) {
    // A new command every 150 ticks, so that kills fall around them too.
    if (index % 150 == 149) {
      ++command.serial;
      command.tool.head.radius_mm = 0.8 + 0.1 * static_cast<double>(command.serial % 5);
      recorder.command(command);
    }
    log.push(servo.step(app::test::sweepingHand(static_cast<double>(index) * 0.001), command, 0.001));
    progress[0].store(index + 1);
    if (index % 20 != 19) continue;
    recorder.drain();
    progress[1].store(index + 1);
  }
}
