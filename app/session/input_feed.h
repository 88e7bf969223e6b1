// What a servo was given, tick by tick, in shared memory that only grows: for a second process that runs the same steps
// again. Inputs and a digest of the outputs, 60 kB a second of rehearsal. A log from the first tick on, not a ring: who
// was away for a minute, or begins late, needs nothing else. Writer: the recorder's thread, 0.1 ms a batch. Readers:
// any process that has the descriptor, each at a place of its own; they trust nothing in it.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/session/compressed.h"
#include "app/session/tick_columns.h"
#include "app/session/tick_tap.h"

namespace app {

class InputFeed : public TickTap {
 public:
  /// Throws SessionError: there is no memory.
  InputFeed();
  ~InputFeed() override;
  InputFeed(const InputFeed&) = delete;
  InputFeed& operator=(const InputFeed&) = delete;

  /// Of the memory, closed in programs that are started.
  int descriptor() const { return memory_; }
  void take(std::span<const SessionCommand> commands, std::span<const haptics::Tick> ticks) noexcept override;
  void end() noexcept override { has_ended_ = true; }
  /// Early, or memory is out. Any thread.
  bool hasEnded() const { return has_ended_.load(std::memory_order_relaxed); }
  std::uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
  /// Ticks that a reader may have seen: up to this number.
  std::uint64_t ticks() const { return ticks_.load(std::memory_order_acquire); }

 private:
  int memory_;
  Compressor compressor_;
  std::vector<std::uint8_t> plain_, record_;
  std::atomic<std::uint64_t> bytes_{0}, ticks_{0};
  std::atomic<bool> has_ended_{false};
};

struct FedTick {
  haptics::Tick input;       ///< number, length, serial of the command and hand; all else as in a new Tick
  std::uint64_t digest = 0;  ///< digestOf() the tick that the servo made
};

struct FedBatch {
  std::vector<SessionCommand> commands;  ///< before the ticks
  std::vector<FedTick> ticks;
};

class InputFeedReader {
 public:
  /// Borrows the descriptor.
  explicit InputFeedReader(int descriptor) : memory_(descriptor) {}

  /// Where it is: a number that another reader of the same feed may continue at.
  std::uint64_t place() const { return at_; }
  void continueAt(std::uint64_t place) { at_ = place; }

  /// None: there is no more yet. Throws SessionError: what is there is no feed.
  std::optional<FedBatch> next();

 private:
  int memory_;
  std::uint64_t at_ = 0;
};

}  // namespace app
