#include "haptics/device/usb/usb_outbox.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace haptics {
namespace {

constexpr std::int64_t kPatience_ns = 20'000'000;
constexpr std::uint8_t kRest = 1, kPush = 2, kLast = 3;

/// What kind it is, and for a push how often the line was rested when it was made and when that was.
struct Note {
  std::uint8_t kind = kRest;
  std::uint32_t rests = 0;
  std::int64_t made_ns = 0;
};

UsbReport written(const Note& note) {
  std::array<std::uint8_t, sizeof(Note)> bytes{};
  std::memcpy(bytes.data(), &note, sizeof note);
  return UsbReport(bytes);
}
Note read(const UsbReport& report) {
  Note note;
  std::memcpy(&note, report.bytes.data(), sizeof note);
  return note;
}

/// Random senders, resters, clocks that jump, and a line that takes or refuses; every report that goes out is checked.
TEST(UsbOutbox, NoForceIsSentAfterARestOrAfterTheLastReport) {
  std::mt19937 generator(17);
  const auto dice = [&](unsigned sides) { return static_cast<unsigned>(generator()) % sides; };
  std::size_t pushes = 0, rests = 0, lasts = 0;
  for (int round = 0; round < 2'000; ++round) {
    UsbOutbox box(written({kRest}), kPatience_ns);
    std::int64_t now_ns = 0, last_deadline_ns = 0;
    bool owes_rest = false, asked_last = false, tried_last = false;
    std::uint32_t tag = 0;
    for (int step = 0; step < 1'000; ++step) {
      now_ns += dice(20) == 0 ? 30'000'000 : dice(2'000'000);
      if (dice(3) == 0) tag = box.rests();  // a tick begins
      if (dice(2) == 0) box.send(written({kPush, tag, now_ns}), tag, now_ns);
      if (dice(25) == 0) box.rest(), owes_rest = true;
      if (dice(700) == 0 && !asked_last) {
        last_deadline_ns = now_ns + 5'000'000;
        box.requestLast(written({kLast}), last_deadline_ns);
        asked_last = true;
      }
      if (asked_last) box.requestLast(written({kPush}), now_ns + 1'000'000'000);  // a later request is ignored
      const bool was_over = box.isOver();
      const auto report = box.next(now_ns);
      if (!report) continue;
      ASSERT_FALSE(was_over);
      const Note note = read(*report);
      const bool taken = dice(4) != 0;
      if (asked_last) {
        ASSERT_EQ(note.kind, kLast);
        ASSERT_TRUE(!tried_last || now_ns < last_deadline_ns) << "one attempt, however late";
        tried_last = true;
        ++lasts;
      } else if (note.kind == kPush) {
        ASSERT_FALSE(owes_rest);
        ASSERT_EQ(note.rests, box.rests());
        ASSERT_LT(now_ns - note.made_ns, kPatience_ns);
        ++pushes;
      } else {
        if (taken) owes_rest = false;
        ++rests;
      }
      if (dice(10) == 0) {
        box.rest();  // while a report is under way
        owes_rest = true;
      }
      taken ? box.taken() : box.notTaken();
      if (asked_last && taken) {
        ASSERT_TRUE(box.isOver() && box.lastWasTaken());
      }
    }
  }
  EXPECT_GT(pushes, 10'000u);
  EXPECT_GT(rests, 10'000u);
  EXPECT_GT(lasts, 1'000u);
}

TEST(UsbOutbox, ASilenceEndsInARestThatIsSentUntilTaken) {
  UsbOutbox box(written({kRest}), kPatience_ns);
  EXPECT_FALSE(box.next(0)) << "who never pushed need not let go";
  box.send(written({kPush}), 0, 1'000);
  ASSERT_EQ(read(*box.next(2'000)).kind, kPush);
  box.taken();
  EXPECT_FALSE(box.next(kPatience_ns + 999));
  EXPECT_EQ(box.nextCheck_ns(-1), kPatience_ns + 1'000);
  for (int refused = 0; refused < 3; ++refused) {
    ASSERT_EQ(read(*box.next(kPatience_ns + 1'000)).kind, kRest);
    box.notTaken();
  }
  ASSERT_EQ(read(*box.next(kPatience_ns + 1'000)).kind, kRest);
  box.taken();
  EXPECT_FALSE(box.next(10 * kPatience_ns));
  EXPECT_EQ(box.nextCheck_ns(-1), -1);
}

TEST(UsbOutbox, HoldsWithThreads) {
  UsbOutbox box(written({kRest}), 0);
  std::atomic<bool> over{false};
  std::thread servo([&] {
    while (!over.load()) {
      const std::uint32_t rests = box.rests();
      box.send(written({kPush, rests, 0}), rests, 0);
    }
  });
  std::thread supervisor([&] {
    while (!over.load()) {
      box.rest();
      std::this_thread::sleep_for(std::chrono::microseconds(20));  // a push must find a gap on a busy machine too
    }
  });
  std::size_t pushes = 0, stale = 0;
  const auto look = [&] {
    const std::uint32_t before = box.rests();
    const auto report = box.next(0);
    if (!report) return;
    const Note note = read(*report);
    if (note.kind == kPush) ++pushes, stale += note.rests < before ? 1 : 0;
    box.taken();
  };
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  for (int i = 0; i < 200'000 || (pushes < 100 && std::chrono::steady_clock::now() < until); ++i) look();
  EXPECT_EQ(stale, 0u);
  EXPECT_GT(pushes, 0u);
  // Two simultaneous last requests: one is sent, and nothing after it.
  std::thread second_sender([&] { box.requestLast(written({kLast}), 1); });
  box.requestLast(written({kLast}), 1);
  second_sender.join();
  std::vector<Note> after;
  for (int i = 0; i < 100'000; ++i)
    if (const auto report = box.next(0)) {
      after.push_back(read(*report));
      box.taken();
    }
  over.store(true);
  servo.join();
  supervisor.join();
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after.front().kind, kLast);
}

}  // namespace
}  // namespace haptics
