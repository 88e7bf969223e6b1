// The victim of the kill test: records made-up ticks in real time at 1 kHz until somebody kills it.
// record_until_killed SESSION PROGRESS: PROGRESS is a file of two numbers that outlives the kill, kept up to date
// through shared memory: ticks logged so far, and the longest time between two of the last 200 ticks in µs.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <ranges>
#include <thread>

#include "app/session/recorder.h"
#include "tests/app/small_session.h"

int main(int, char** argv) {
  using Clock = std::chrono::steady_clock;
  const int file = ::open(argv[2], O_RDWR);
  void* memory = ::mmap(nullptr, 16, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) return 1;
  auto* progress = static_cast<std::atomic<std::uint64_t>*>(memory);

  haptics::TickLog log;
  const app::test::SmallBone bone;
  app::Recorder recorder(argv[1], false, bone.start(), log);
  std::deque<std::uint64_t> pauses;
  auto due = Clock::now(), before = due;
  for (std::uint64_t index = 0;; ++index) {
    log.push(app::test::imaginedTick(index));
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
