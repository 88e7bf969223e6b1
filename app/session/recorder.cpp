#include "app/session/recorder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "app/session/session_error.h"
#include "app/session/session_writer.h"

namespace app {

namespace {
constexpr std::chrono::milliseconds kBetweenWrites{20};
}

struct Recorder::Impl {
  haptics::TickLog& log;

  // Shared with the callers, under the mutex.
  mutable std::mutex mutex;
  std::condition_variable wake;
  bool stopping = false;
  std::vector<haptics::Command> asked_commands;
  std::vector<SessionEvent> events;
  std::vector<SessionPicture> pictures;
  std::optional<std::string> trouble;

  // The recording thread's own.
  SessionWriter writer;
  std::vector<haptics::Command> waiting_commands;
  std::uint64_t serial_in_force, ticks_seen = 0, next_index = 0, gaps = 0;
  bool writing = true;

  std::optional<RecordingSummary> summary;
  std::thread thread;

  Impl(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& ticks)
      : log(ticks), writer(path, overwrite, start), serial_in_force(start.command.serial), thread([this] { run(); }) {}

  void run() {
    for (bool last = false; !last;) {
      SessionBatch batch;
      {
        std::unique_lock lock(mutex);
        wake.wait_for(lock, kBetweenWrites, [this] { return stopping; });
        last = stopping;
        // Ticks first: a command in force in any of them was asked for before it was published.
        log.drainInto(batch.ticks);
        waiting_commands.insert(waiting_commands.end(), asked_commands.begin(), asked_commands.end());
        asked_commands.clear();
        batch.events.swap(events);
        batch.pictures.swap(pictures);
      }
      noteTicks(batch);
      if (writing) write(batch);
      if (last && writing) seal();
    }
  }

  /// Finds where commands came into force and where ticks are missing.
  void noteTicks(SessionBatch& batch) {
    for (SessionEvent& event : batch.events) event.tick = next_index;
    for (SessionPicture& picture : batch.pictures) picture.tick = next_index;
    for (const haptics::Tick& tick : batch.ticks) {
      if (tick.index > next_index) {
        gaps += tick.index - next_index;
        batch.events.push_back({next_index, "lost", std::to_string(tick.index - next_index) + " ticks"});
      }
      if (tick.command_serial != serial_in_force) noteCommand(batch, tick);
      next_index = tick.index + 1;
    }
    ticks_seen += batch.ticks.size();
  }

  /// Earlier ones still waiting were overtaken before any tick saw them: newest wins.
  void noteCommand(SessionBatch& batch, const haptics::Tick& tick) {
    serial_in_force = tick.command_serial;
    const auto found = std::ranges::find(waiting_commands, serial_in_force, &haptics::Command::serial);
    if (found == waiting_commands.end()) {
      batch.events.push_back({tick.index, "lost", "command " + std::to_string(serial_in_force) + " was never told"});
      return;
    }
    batch.commands.push_back({*found, tick.index});
    waiting_commands.erase(waiting_commands.begin(), found + 1);
  }

  void write(const SessionBatch& batch) {
    if (batch.ticks.empty() && batch.events.empty() && batch.pictures.empty()) return;
    attempt([&] { writer.write(batch); });
  }

  void seal() {
    attempt([&] { writer.seal(lost()); });
  }

  /// A gap that no later tick shows is known to the log alone.
  std::uint64_t lost() const { return std::max(gaps, log.dropped()) + ticks_seen - writer.ticks(); }

  template <class Work>
  void attempt(Work&& work) {
    try {
      work();
    } catch (const std::exception& failed) {
      writing = false;
      const std::scoped_lock lock(mutex);
      trouble = std::string("the recording ended early: ") + failed.what();
    }
  }
};

Recorder::Recorder(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& log)
    : impl_(std::make_unique<Impl>(path, overwrite, start, log)) {}

Recorder::~Recorder() { stop(); }

void Recorder::command(const haptics::Command& command) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->asked_commands.push_back(command);
}

void Recorder::event(std::string kind, std::string text) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->events.push_back({0, std::move(kind), std::move(text)});
}

void Recorder::picture(std::string name, std::vector<std::uint8_t> bytes) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->pictures.push_back({0, std::move(name), std::move(bytes)});
}

std::optional<std::string> Recorder::trouble() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->trouble;
}

RecordingSummary Recorder::stop() {
  if (impl_->summary) return *impl_->summary;
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->stopping = true;
  }
  impl_->wake.notify_one();
  impl_->thread.join();
  impl_->summary = RecordingSummary{impl_->writer.ticks(), impl_->lost(), impl_->trouble};
  return *impl_->summary;
}

}  // namespace app
