// The victim of the kill test: a real servo carves a block of bone in real time at 1 kHz and is recorded, until
// somebody kills it. record_until_killed SESSION PROGRESS: PROGRESS is a file of two numbers that outlives the kill,
// kept up to date through shared memory: ticks logged so far, and the longest time between two of the last 200 ticks in
// µs.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <thread>

#include "tests/app/real_session.h"

int main(int, char** argv) {
  using Clock = std::chrono::steady_clock;
  const int file = ::open(argv[2], O_RDWR);
  void* memory = ::mmap(nullptr, 16, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) return 1;
  auto* progress = static_cast<std::atomic<std::uint64_t>*>(memory);

  const app::test::BoneBlock block;
  haptics::CarvedBone bone(block.grid, block.solid, block.label);
  haptics::Servo servo(bone);
  haptics::TickLog log;
  app::Recorder recorder(argv[1], false, block.start(), log);
  haptics::Command command = block.start().command;

  std::deque<std::uint64_t> pauses;
  auto due = Clock::now(), before = due;
  for (std::uint64_t index = 0;; ++index) {
    // A new command every 150 ms, so that kills fall around them too.
    if (index % 150 == 149) {
      ++command.serial;
      command.tool.head.radius_mm = 0.8 + 0.1 * static_cast<double>(command.serial % 5);
      recorder.command(command);
    }
    log.push(servo.step(app::test::sweepingHand(static_cast<double>(index) * 0.001), command, 0.001));
    const auto now = Clock::now();
    pauses.push_back(static_cast<std::uint64_t>((now - before) / std::chrono::microseconds(1)));
    if (pauses.size() > 200) pauses.pop_front();
    before = now;
    progress[1].store(std::ranges::max(pauses));
    progress[0].store(index + 1);
    due += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(due);
  }
}
